// How strongly a hidden effect shows, against the noise: from the truth, with no fit of the tool.
#pragma once

#include "blind/world.hpp"
#include "model/model.hpp"

namespace blind {

// As shares of the torque's rms in a band: what the hidden effects leave when the known part is
// fitted to them at its best, and what noise leaves.
struct Strength {
    double share = 0, floor = 0;
    double torque_rms = 0;
    double ratio() const { return floor > 0 ? share / floor : 1e9; }
};

// without: the same world less the hidden effects. known: the names of its effects decide what the
// residual is freed from (viscous, coulomb, constant_torque).
Strength measure(const World& world, const World& without, const servoid::Model& known,
                 const Record& record, double band_Hz);

} // namespace blind
