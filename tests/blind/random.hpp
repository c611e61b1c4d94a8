// Draws of the blind test, reproducible from an effect, a seed and an attempt.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace blind {

class Random {
  public:
    Random(const std::string& what, std::uint64_t seed, std::uint64_t attempt) {
        std::vector<std::uint32_t> words;
        for (char c : what)
            words.push_back(static_cast<unsigned char>(c));
        words.push_back(static_cast<std::uint32_t>(seed));
        words.push_back(static_cast<std::uint32_t>(attempt));
        std::seed_seq sequence(words.begin(), words.end());
        engine_.seed(sequence);
    }

    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    double log_uniform(double low, double high) {
        return std::exp(uniform(std::log(low), std::log(high)));
    }
    int integer(int low, int high) { // inclusive
        return std::uniform_int_distribution<int>(low, high)(engine_);
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }
    double sign() { return chance(0.5) ? 1 : -1; }
    template <class T> const T& pick(const std::vector<T>& from) {
        return from[static_cast<size_t>(integer(0, static_cast<int>(from.size()) - 1))];
    }
    std::uint64_t word() { return engine_(); }

  private:
    std::mt19937_64 engine_;
};

} // namespace blind
