// The drives of the blind test: both of the paper and two linear axes, each a little different in
// every case.
#pragma once

#include "blind/random.hpp"
#include "blind/world.hpp"
#include "model/model.hpp"

#include <string>

namespace blind {

struct System {
    std::string name;
    World world;      // inertia, viscous and Coulomb friction, loop, encoder; nothing else
    double rated = 0; // N·m or N
    double speed = 0, acceleration = 0; // of a brisk move
    double lead = 0;                    // metres per turn of a linear axis
    double band_Hz = 0;                 // up to which it can be excited
    int bits = 0;
    bool modes_known = false; // world.modes is in the believed model
};

const std::vector<std::string>& system_names();
System draw_system(const std::string& name, Random& random);

// What the user believes of the world: its loop, its encoder, its drive, and these effects.
servoid::Model believed(const System& system, const std::vector<servoid::EffectTerm>& effects);

} // namespace blind
