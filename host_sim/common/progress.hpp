// How far long work is.
#pragma once

#include <functional>
#include <string>

namespace servoid {

// Told from time to time by the thread that asked for the work: what is done now, and how much of
// it is done, 0…1. From 1 on the rest takes a time that nobody can tell. May be empty.
using Progress = std::function<void(const std::string& what, double share)>;

} // namespace servoid
