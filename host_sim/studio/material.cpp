#include "studio/material.hpp"

#include "common/error.hpp"

#include <utility>

namespace servoid::studio {

Material::Material(Recordings recordings, const MotionOptions& options)
    : recordings_(std::move(recordings)) {
    for (const auto& r : recordings_)
        if (r->on) motions_.push_back(prepare_motion(r->capture, options));
    if (motions_.empty()) throw UsageError("at least one capture must be on");
}

std::vector<SourceFile> Material::sources() const {
    std::vector<SourceFile> out;
    for (const auto& r : recordings_)
        if (r->on) out.push_back(r->source);
    return out;
}

} // namespace servoid::studio
