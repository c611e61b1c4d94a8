// The captures of a studio: read once, prepared once, never changed.
#pragma once

#include "compare/motion.hpp"
#include "model/model.hpp"
#include "story/provenance.hpp"

#include <memory>
#include <string>
#include <vector>

namespace servoid::studio {

struct Recording {
    Capture capture;
    SourceFile source;
    bool on = true; // false: kept, not looked at
};
using Recordings = std::vector<std::shared_ptr<const Recording>>;

// The captures that are on, prepared. Shared by all steps that look at the same ones.
class Material {
  public:
    // Throws Refusal where one of them holds too little.
    Material(Recordings recordings, const MotionOptions& options);
    Material(const Material&) = delete;
    Material& operator=(const Material&) = delete;

    const Recordings& recordings() const { return recordings_; }
    const std::vector<PreparedMotion>& motions() const { return motions_; }
    std::vector<SourceFile> sources() const;

  private:
    Recordings recordings_;
    std::vector<PreparedMotion> motions_;
};

} // namespace servoid::studio
