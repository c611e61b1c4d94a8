// An end of a bus that loses, repeats and spoils what it hears and says, by a seed.
#pragma once

#include "can/bus.hpp"

#include <optional>
#include <random>
#include <utility>

namespace servoid::can {

struct Faults {
    double lose = 0, repeat = 0, shorten = 0; // shares of the frames
};

class FaultyBus : public Bus {
  public:
    FaultyBus(Bus& bus, Faults faults, unsigned seed) : bus_(bus), faults_(faults), random_(seed) {}
    void send(const Frame& frame) override {
        if (!happens(faults_.lose)) bus_.send(spoilt(frame));
        if (happens(faults_.repeat)) bus_.send(frame);
    }
    bool receive(Frame& frame, std::chrono::nanoseconds wait) override {
        if (again_) return frame = *std::exchange(again_, std::nullopt), true;
        if (!bus_.receive(frame, wait) || happens(faults_.lose)) return false;
        if (happens(faults_.repeat)) again_ = frame;
        frame = spoilt(frame);
        return true;
    }
    const BusHealth& health() const override { return bus_.health(); }

  private:
    bool happens(double share) { return std::uniform_real_distribution<>()(random_) < share; }
    Frame spoilt(Frame frame) {
        if (frame.length > 1 && happens(faults_.shorten)) frame.length /= 2;
        return frame;
    }
    Bus& bus_;
    Faults faults_;
    std::mt19937 random_;
    std::optional<Frame> again_;
};

} // namespace servoid::can
