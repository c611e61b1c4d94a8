// A row of numbers as a row of characters.
#pragma once

#include <string>
#include <vector>

namespace servoid {

// One character a value: the higher, the larger; zero is in the middle, ± full_scale and beyond at
// the ends. blocks: ▁▂▃▄▅▆▇, else _ . - ' " of ASCII.
std::string sparkline(const std::vector<double>& values, double full_scale, bool blocks);

// The same for what has no sign: from 0 to full_scale and beyond. blocks: ▁▂▃▄▅▆▇█, else the
// darker, the larger: . : - = + * # @ of ASCII. A value that is not finite is a blank.
std::string skyline(const std::vector<double>& values, double full_scale, bool blocks);

} // namespace servoid
