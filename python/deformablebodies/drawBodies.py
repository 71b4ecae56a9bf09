"""Bodies of a case as a picture, at its last time: membranes coloured by their larger principal
tension over Gs, fibres as tubes.

    drawBodies                                   in the case directory: bodies.png
    drawBodies mine picture.png --radius 0.185   fibres of another radius [m]
    drawBodies --strip cells                     one body at several times, side by side
"""
import argparse
import os
import sys
from . import bodies3d
from .case import Case


def main():
    parser = argparse.ArgumentParser(prog="drawBodies", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", nargs="?", default=".")
    parser.add_argument("picture", nargs="?", default="bodies.png")
    parser.add_argument("--radius", type=float, help="of fibres [m] (default: half their diameter)")
    parser.add_argument("--strip", metavar="GROUP", help="the only body of a group at several times")
    parser.add_argument("--size", type=float,
                        help="of the square of a body in a strip [m] (default: 1.25 times its longest side)")
    parser.add_argument("--perRow", type=int, default=4, help="pictures in each of the two rows of a strip")
    options = parser.parse_args()
    case = Case(options.case)
    if not case.groups():
        sys.exit("drawBodies: %s has no postProcessing/VTK/bodies: it was not run, or has no bodies" % case.folder)
    if options.strip and options.strip not in case.groups():
        sys.exit("drawBodies: there is no group '%s', allowed: %s" % (options.strip, " ".join(case.groups())))
    if options.strip:
        last = bodies3d.read(case.pictures(options.strip)[-1][1]).GetPointData()
        if not last.HasArray("tension1") or last.GetArray("body").GetRange()[1] > 0:
            sys.exit("drawBodies: --strip is '%s', allowed: a group of one capsule" % options.strip)
    if options.perRow < 1 or any(size is not None and size <= 0 for size in (options.size, options.radius)):
        sys.exit("drawBodies: --perRow, --size and --radius are greater than 0")
    if not options.picture.endswith(".png"):
        sys.exit("drawBodies: the picture is '%s', allowed: a name that ends with .png" % options.picture)
    bodies3d.onDisplay()
    os.makedirs(os.path.dirname(os.path.abspath(options.picture)), exist_ok=True)
    if options.strip:
        bodies3d.strip(case, options.picture, options.strip, options.size, options.perRow)
    else:
        bodies3d.suspension(case, options.picture, options.radius)
    print("Written: " + options.picture)


if __name__ == "__main__":
    main()
