// This file is part of deformableBodies. License: GPL-3.0-or-later.

#include "bodyScene.H"
#include "dictionaryChecks.H"
#include "Enum.H"

Foam::bodyCoupling Foam::readCoupling(const dictionary& dict,
                                      const bodyCoupling otherwise)
{
    return readEnum(Enum<bodyCoupling>({{bodyCoupling::none, "none"},
                                        {bodyCoupling::oneWay, "oneWay"},
                                        {bodyCoupling::twoWay, "twoWay"}}),
                    dict, "coupling", otherwise);
}

bool Foam::removesOutside(const dictionary& dict, const bool otherwise)
{
    return readEnum(Enum<bool>({{false, "stop"}, {true, "remove"}}), dict,
                    "outside", otherwise);
}
