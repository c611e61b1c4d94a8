// How each effect is hidden: what the user knows beside it, the experiments that can show it, and
// its parameters as a function of one number, the strength.
#pragma once

#include "blind/moves.hpp"
#include "blind/systems.hpp"

#include <functional>
#include <string>
#include <vector>

namespace blind {

// The motion of the axis without the effect, for parameters that have to fit it.
struct Motion {
    double travel = 0, lowest = 0, highest = 0, top_speed = 0, typical_speed = 0;
    double top_torque = 0, duration_s = 0, top_Hz = 0;
    double step_s = 0;
    double stuck = 0; // share of the time
};

struct Plan {
    std::string effect;
    std::vector<std::string> takes_out; // known friction that is not in the world
    std::vector<std::string> forgets;   // known friction that is in the world but not believed
    std::function<servoid::EffectTerm(double)> at; // strength → hidden effect
    double start = 1, least = 0, most = 1e300;     // of the strength
};

// Experiments by what they excite.
enum class Excites { friction, position, dynamics, anything };

Excites excites(const std::string& effect);
bool suits(const std::string& effect, const System& system);
Plan draw_plan(const std::string& effect, const System& system, const Motion& motion,
               Random& random);

const std::vector<std::string>& hidden_effects();  // of the catalogue
const std::vector<std::string>& foreign_effects(); // of no catalogue

} // namespace blind
