// This file is part of deformableBodies. License: GPL-3.0-or-later.

// Membrane laws alone. Exact solutions on a surface: testMembrane.C

#include "IStringStream.H"
#include "membraneModel.H"
#include "unitTest.H"

using namespace Foam;

TEST(MembraneModel, uniaxialExtension)
{
    // Tension T1 at the stretches l1 along and l2 across for which T2 = 0
    const auto tensions =
        [](const char* entries, const double l1, const double l2)
    {
        IStringStream is(entries);
        const dictionary dict(is);
        const auto law = membraneModel::New(dict);
        const double I1 = l1 * l1 + l2 * l2 - 2, I2 = sqr(l1 * l2) - 1;
        double W, W1, W2;
        law->evaluate(1, &I1, &I2, &W, &W1, &W2);
        return std::make_pair(2 * l1 / l2 * (W1 + l2 * l2 * W2),
                              2 * l2 / l1 * (W1 + l1 * l1 * W2));
    };
    double neo = 0, skalak = 0;
    for (const double l : {0.8, 1.1, 1.5, 2.0, 3.0})
    {
        const auto n = tensions("law neoHookean; Gs 1;", l, 1 / std::sqrt(l));
        neo = max(neo, mag(n.first - std::pow(l, 1.5) + std::pow(l, -1.5)));
        neo = max(neo, mag(n.second));

        const double C = 5, l2 = std::sqrt((1 + C * l * l) / (1 + C * pow4(l)));
        const auto s = tensions("law Skalak; Gs 1; C 5;", l, l2);
        const double exact =
            l / l2 * ((l * l - 1) + C * l2 * l2 * (l * l * l2 * l2 - 1));
        skalak = max(skalak, mag(s.first - exact) / max(1.0, mag(exact)));
        skalak = max(skalak, mag(s.second));
    }
    test::expectBelow("uniaxial extension, neo-Hookean", neo, 1e-12);
    test::expectBelow("uniaxial extension, Skalak C = 5", skalak, 1e-12);
}
