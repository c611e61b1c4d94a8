#include "blind/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace blind {

Figures figures_of(const std::vector<Verdict>& verdicts) {
    Figures f;
    for (const Verdict& v : verdicts) {
        ++f.cases;
        f.right += v.first_right;
        f.missing += v.first_right && v.verdict == "missing";
        f.ambiguous += v.first_right && v.verdict == "ambiguous";
        f.adequate += v.verdict == "adequate";
        f.unknown_or_ambiguous += v.verdict == "unknown" || v.verdict == "ambiguous";
        f.found_all += v.all_found;
        f.thrown += !v.failure.empty();
        f.to_floor += v.first_right && v.error_after <= 1.1 * v.floor;
        f.to_complete += v.first_right && v.complete_error > 0 &&
                         v.error_after <= 1.1 * std::max(v.floor, v.complete_error);
        f.to_true_floor += v.first_right && v.error_after <= 1.1 * std::max(v.floor, v.true_floor);
        for (const ParameterCheck& p : v.parameters)
            ++f.parameters, f.good_parameters += p.good;
        f.seconds += v.seconds;
        f.slowest = std::max(f.slowest, v.seconds);
    }
    return f;
}

std::string text_of(const Figures& f) {
    const auto share = [](int part, int whole) {
        return fmt::format("{}/{} ({:.1f} %)", part, whole, whole ? 100.0 * part / whole : 0.0);
    };
    return fmt::format(
        "named first {} (missing {}, ambiguous {}), parameters {}, to the floor {} "
        "(true floor {}, complete model {}), "
        "adequate {}, unknown or ambiguous {}, all found {}, thrown {}, "
        "{:.2f} s each, slowest {:.2f} s",
        share(f.right, f.cases), f.missing, f.ambiguous, share(f.good_parameters, f.parameters),
        share(f.to_floor, f.right), share(f.to_true_floor, f.right), share(f.to_complete, f.right),
        share(f.adequate, f.cases), share(f.unknown_or_ambiguous, f.cases),
        share(f.found_all, f.cases), f.thrown, f.cases ? f.seconds / f.cases : 0.0, f.slowest);
}

std::string confusion_matrix(const std::vector<Verdict>& verdicts) {
    std::map<std::string, std::map<std::string, int>> rows;
    std::map<std::string, std::pair<int, int>> right; // right of all
    std::vector<std::string> order;
    for (const Verdict& v : verdicts) {
        if (!rows.count(v.truth)) order.push_back(v.truth);
        ++rows[v.truth][v.named];
        right[v.truth].first += v.first_right;
        right[v.truth].second += 1;
    }
    std::string out = "| hidden | right | named |\n|---|---|---|\n";
    for (const std::string& truth : order) {
        std::vector<std::pair<int, std::string>> named;
        for (const auto& [name, count] : rows[truth])
            named.emplace_back(-count, name);
        std::sort(named.begin(), named.end());
        std::string cell;
        for (const auto& [count, name] : named)
            cell += fmt::format("{}{} {}", cell.empty() ? "" : ", ", name, -count);
        out += fmt::format("| {} | {}/{} | {} |\n", truth, right[truth].first, right[truth].second,
                           cell);
    }
    return out;
}

std::string calibration(const std::vector<Verdict>& verdicts) {
    const std::vector<double> edges = {0, 0.5, 0.7, 0.85, 0.95, 0.99, 1.0000001};
    std::string out = "| probability | verdicts | mean probability | right |\n|---|---|---|---|\n";
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
        int count = 0, right = 0;
        double sum = 0;
        for (const Verdict& v : verdicts) {
            if (v.verdict != "missing" && v.verdict != "ambiguous") continue;
            if (v.probability < edges[i] || v.probability >= edges[i + 1]) continue;
            ++count, right += v.first_right, sum += v.probability;
        }
        out += fmt::format("| {}–{} | {} | {:.3f} | {:.3f} |\n", edges[i],
                           std::min(1.0, edges[i + 1]), count, count ? sum / count : 0.0,
                           count ? right / static_cast<double>(count) : 0.0);
    }
    return out;
}

} // namespace blind
