// Many cases, on several threads, always in the same order.
#pragma once

#include "blind/judge.hpp"

#include <functional>
#include <string>
#include <vector>

namespace blind {

struct Job {
    std::vector<std::string> effects; // empty: nothing hidden
    int seed = 1;
    bool refine = false;
};

using Listener = std::function<void(const Case&, const Verdict&)>; // one call at a time

// A job whose case cannot be made throws out of here.
std::vector<Verdict> run_jobs(const std::vector<Job>& jobs, int threads,
                              const Listener& listener = {});

std::vector<Job> hidden_jobs(int first_seed, int last_seed);  // each effect of the catalogue
std::vector<Job> foreign_jobs(int first_seed, int last_seed); // each effect of no catalogue
std::vector<Job> nothing_jobs(int first_seed, int last_seed);
std::vector<Job> pair_jobs(int first_seed, int last_seed);

} // namespace blind
