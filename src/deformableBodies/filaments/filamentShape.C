// This file is part of deformableBodies. License: GPL-3.0-or-later.

// What is reported and drawn of filaments

#include "filaments.H"
#include "mathematicalConstants.H"
#include <cmath>

Foam::wordList Foam::filaments::columns() const
{
    return {"x",      "y",          "z",        "tipX",
            "tipY",   "tipZ",       "endToEnd", "lengthError",
            "energy", "maxTension", "angle",    "iterations",
            "forceX", "forceY",     "forceZ",   "slip"};
}

Foam::scalarList Foam::filaments::sample(const label i) const
{
    const filament& x = filaments_[i].line;
    const vectorField& X = x.places();
    const label N = properties_.segments;
    const vector force(sum(filaments_[i].forces));
    vector centre(Zero);
    for (label k = 0; k < N; ++k)
    {
        centre += 0.5 / N * (X[k] + X[k + 1]);
    }
    const vector across(X[N] - X[0]);
    return {centre.x(),
            centre.y(),
            centre.z(),
            X[N].x(),
            X[N].y(),
            X[N].z(),
            mag(across),
            x.lengthError(),
            x.kineticEnergy() + x.bendingEnergy(),
            max(x.tensions()),
            180 / constant::mathematical::pi *
                std::atan2(across[shearPlane_[1]], across[shearPlane_[0]]),
            scalar(x.iterations()),
            force.x(),
            force.y(),
            force.z(),
            filaments_[i].slip};
}

// A tube of six sides, so that it is seen as thick as it is
Foam::bodySurface Foam::filaments::surface(const label i) const
{
    const filament& x = filaments_[i].line;
    const vectorField& X = x.places();
    const label N = properties_.segments, sides = 6, n = sides * (N + 1);

    bodySurface s;
    s.vectorNames = {"velocity"};
    s.scalarNames = {"tension", "curvature"};
    s.vectors.setSize(1, vectorField(n));
    s.scalars.setSize(2, scalarField(n));
    s.points.setSize(n);
    vector e(Zero);
    for (label k = 0; k <= N; ++k)
    {
        const label before = max(k - 1, label(0)), after = min(k + 1, N);
        vector t(X[after] - X[before]);
        t /= mag(t);

        // The frame follows the filament without turning about it
        if (k == 0) e = mag(t.x()) < 0.7 ? vector(1, 0, 0) : vector(0, 1, 0);
        e -= (e & t) * t;
        e /= mag(e);
        const scalar curvature =
            k > 0 && k < N
                ? mag(X[k + 1] - 2 * X[k] + X[k - 1]) / sqr(properties_.ds())
                : 0;
        const scalar tension = 0.5 * (x.tensions()[max(k - 1, label(0))] +
                                      x.tensions()[min(k, N - 1)]);
        for (label j = 0; j < sides; ++j)
        {
            const scalar a = constant::mathematical::twoPi * j / sides;
            const label p = sides * k + j;
            s.points[p] =
                X[k] + radius_ * (std::cos(a) * e + std::sin(a) * (t ^ e));
            s.vectors[0][p] = x.velocities()[k];
            s.scalars[0][p] = tension;
            s.scalars[1][p] = curvature;
        }
    }
    DynamicList<face> faces;
    for (label k = 0; k < N; ++k)
    {
        for (label j = 0; j < sides; ++j)
        {
            const label a = sides * k + j, b = sides * k + (j + 1) % sides;
            face quad(4);
            quad[0] = a;
            quad[1] = b;
            quad[2] = b + sides;
            quad[3] = a + sides;
            faces.append(quad);
        }
    }
    s.faces.transfer(faces);
    return s;
}
