// The blind test by hand: cases of one effect or of all, listed and summed up.
#include "blind/campaign.hpp"
#include "blind/tables.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

namespace {

const char* const kHelp = R"(servoid_blind WHAT... [options]

WHAT: all | nothing | pairs | foreign | an effect | effect+effect (several hidden)
  --seeds A..B   (default 1..10)
  -v             everything about each case
  -q             only the sums
  -w             with -v: only the cases that go wrong
  -j N           threads (default 2)
  --refine       refine instead of diagnose (pairs: always)
  --save DIR     write DIR/<case>.toml and .csv as a user would have them
  --cases        make and list the cases, diagnose nothing
)";

struct Request {
    std::vector<std::string> what;
    int first = 1, last = 10, threads = 2;
    bool verbose = false, quiet = false, wrong_only = false, refine = false, cases_only = false;
    std::string save;
};

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> out(1);
    for (char c : text) {
        if (c == '+')
            out.emplace_back();
        else
            out.back() += c;
    }
    return out;
}

Request parse(int count, char** words) {
    Request r;
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto next = [&] { return std::string(i + 1 < count ? words[++i] : ""); };
        if (word == "--seeds") {
            const std::string range = next();
            const size_t dots = range.find("..");
            r.first = std::stoi(range);
            r.last = dots == std::string::npos ? r.first : std::stoi(range.substr(dots + 2));
        } else if (word == "-j")
            r.threads = std::stoi(next());
        else if (word == "-v")
            r.verbose = true;
        else if (word == "-q")
            r.quiet = true;
        else if (word == "-w")
            r.wrong_only = true;
        else if (word == "--refine")
            r.refine = true;
        else if (word == "--cases")
            r.cases_only = true;
        else if (word == "--save")
            r.save = next();
        else if (word.starts_with("-"))
            throw std::invalid_argument("no such option: " + word + "\n" + kHelp);
        else
            r.what.push_back(word);
    }
    return r;
}

std::vector<blind::Job> jobs_of(const Request& r) {
    std::vector<blind::Job> out;
    const auto add = [&](const std::vector<blind::Job>& more) {
        out.insert(out.end(), more.begin(), more.end());
    };
    for (const std::string& what : r.what) {
        if (what == "all")
            add(blind::hidden_jobs(r.first, r.last));
        else if (what == "nothing")
            add(blind::nothing_jobs(r.first, r.last));
        else if (what == "pairs")
            add(blind::pair_jobs(r.first, r.last));
        else if (what == "foreign")
            add(blind::foreign_jobs(r.first, r.last));
        else
            for (int seed = r.first; seed <= r.last; ++seed)
                out.push_back({split(what), seed, false});
    }
    if (r.refine)
        for (blind::Job& job : out)
            job.refine = true;
    return out;
}

void save(const blind::Case& c, const std::string& folder) {
    std::string name;
    for (const std::string& e : c.effects)
        name += e + "_";
    name = folder + "/" + (name.empty() ? "nothing_" : name) + std::to_string(c.seed);
    std::ofstream(name + ".toml") << servoid::format_model(c.known);
    std::ofstream(name + ".csv") << servoid::format_capture_csv(c.capture);
}

int list_cases(const Request& r) {
    for (const blind::Job& job : jobs_of(r)) {
        const blind::Case c = blind::make_case(job.effects, job.seed);
        if (!r.save.empty()) save(c, r.save);
        blind::Verdict v;
        v.truth = c.hidden.empty() ? "nothing" : c.hidden.front().name;
        fmt::print("{}", blind::describe(c, v, true));
        fmt::print("    attempt {}\n", c.attempt);
    }
    return 0;
}

int campaign(const Request& r) {
    const auto listener = [&](const blind::Case& c, const blind::Verdict& v) {
        if (!r.save.empty()) save(c, r.save);
        if (!r.quiet && !(r.wrong_only && blind::as_it_should(c, v)))
            fmt::print("{}", blind::describe(c, v, r.verbose)), std::fflush(stdout);
    };
    const auto verdicts = blind::run_jobs(jobs_of(r), r.threads, listener);
    fmt::print("\n{}\n{}\n{}\n", blind::confusion_matrix(verdicts), blind::calibration(verdicts),
               blind::text_of(blind::figures_of(verdicts)));
    return 0;
}

} // namespace

int main(int count, char** words) {
    try {
        const Request request = parse(count, words);
        if (request.what.empty()) {
            fmt::print("{}", kHelp);
            return 2;
        }
        return request.cases_only ? list_cases(request) : campaign(request);
    } catch (const std::exception& e) {
        fmt::print(stderr, "servoid_blind: {}\n", e.what());
        return 1;
    }
}
