// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyReport.H"

Foam::faceList Foam::ringFaces(const label nRings, const label nAround)
{
    faceList faces((nRings - 1) * nAround + 2, face(4));
    for (label f = 0; f + 2 < faces.size(); ++f)
    {
        const label ring = f / nAround * nAround, next = (f + 1) % nAround;
        faces[f][0] = f;
        faces[f][1] = f + nAround;
        faces[f][2] = ring + next + nAround;
        faces[f][3] = ring + next;
    }
    face north(nAround), south(nAround);
    for (label j = 0; j < nAround; ++j)
    {
        north[j] = j;
        south[j] = nRings * nAround - 1 - j;
    }
    faces[faces.size() - 2] = north;
    faces[faces.size() - 1] = south;
    return faces;
}

Foam::string Foam::bodyReport::smallerSteps(const bodyScene& scene)
{
    if (!scene.adjusted) return "deltaT to a smaller step";
    return string("maxDeltaT of system/controlDict to a smaller step") +
           (scene.forceAtFaces ? ", or accuracy to a smaller number" : "");
}
