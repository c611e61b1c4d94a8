#include "story/series.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace servoid {

namespace {

constexpr int kTop = 32767; // of a value; −32768 is none

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void take(double value) {
        if (!std::isfinite(value)) return;
        low = std::min(low, value), high = std::max(high, value);
    }
    bool empty() const { return !(low <= high); }
};

// value = offset + scale·code.
struct Scale {
    double offset = 0, scale = 1;
    explicit Scale(const Range& all) {
        if (all.empty()) return;
        offset = 0.5 * all.low + 0.5 * all.high;
        scale = std::max((all.high - offset) / kTop, std::numeric_limits<double>::min());
    }
    int16_t code(double value) const {
        if (!std::isfinite(value)) return INT16_MIN;
        return int16_t(std::clamp<long>(std::lround((value - offset) / scale), -kTop, kTop));
    }
};

std::string base64(const std::vector<int16_t>& codes) {
    static constexpr char digits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve(codes.size() * 8 / 3 + 4);
    uint32_t bits = 0;
    int count = 0;
    const auto take = [&](unsigned byte) {
        bits = bits << 8 | byte, count += 8;
        while (count >= 6)
            count -= 6, out += digits[bits >> count & 63U];
    };
    for (const int16_t code : codes)
        take(uint16_t(code) & 255U), take(uint16_t(code) >> 8U);
    if (count > 0) out += digits[bits << (6 - count) & 63U];
    while (out.size() % 4)
        out += '=';
    return out;
}

std::vector<Range> buckets_of(std::span<const double> values, size_t bucket) {
    std::vector<Range> out((values.size() + bucket - 1) / bucket);
    for (size_t i = 0; i < values.size(); ++i)
        out[i / bucket].take(values[i]);
    return out;
}

std::string packed(const std::vector<Range>& buckets, const Scale& scale, double Range::*end) {
    std::vector<int16_t> codes;
    codes.reserve(buckets.size());
    for (const Range& r : buckets)
        codes.push_back(scale.code(r.*end));
    return base64(codes);
}

} // namespace

Json series_json(std::span<const double> values, const SeriesAxis& axis, size_t most) {
    if (values.empty()) return nullptr;
    const size_t bucket = (values.size() + most - 1) / most;
    const std::vector<Range> buckets = buckets_of(values, bucket);
    Range all;
    for (const Range& r : buckets)
        all.take(r.low), all.take(r.high);
    const Scale scale(all);
    return {{"start_s", axis.start_s},
            {"step_s", axis.step_s * double(bucket)},
            {"count", buckets.size()},
            {"bucket", bucket},
            {"offset", scale.offset},
            {"scale", scale.scale},
            {"low", packed(buckets, scale, &Range::low)},
            {"high", bucket > 1 ? Json(packed(buckets, scale, &Range::high)) : Json(nullptr)}};
}

} // namespace servoid
