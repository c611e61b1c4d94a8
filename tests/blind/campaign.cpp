#include "blind/campaign.hpp"

#include <atomic>
#include <mutex>
#include <thread>

namespace blind {

namespace {

std::vector<Job> jobs_of(const std::vector<std::vector<std::string>>& what, int first, int last,
                         bool refine) {
    std::vector<Job> out;
    for (const auto& effects : what)
        for (int seed = first; seed <= last; ++seed)
            out.push_back({effects, seed, refine});
    return out;
}

std::vector<std::vector<std::string>> one_by_one(const std::vector<std::string>& effects) {
    std::vector<std::vector<std::string>> out;
    for (const std::string& e : effects)
        out.push_back({e});
    return out;
}

} // namespace

std::vector<Verdict> run_jobs(const std::vector<Job>& jobs, int threads, const Listener& listener) {
    std::vector<Verdict> out(jobs.size());
    std::atomic<size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr thrown;
    const auto work = [&] {
        for (size_t i = next++; i < jobs.size(); i = next++) {
            try {
                const Case c = make_case(jobs[i].effects, jobs[i].seed);
                out[i] = jobs[i].refine ? judge_refine(c) : judge(c);
                const std::lock_guard lock(mutex);
                if (listener) listener(c, out[i]);
                out[i].diagnosis = {}; // large
            } catch (...) {
                const std::lock_guard lock(mutex);
                thrown = std::current_exception();
            }
        }
    };
    std::vector<std::thread> pool;
    for (int i = 1; i < threads; ++i)
        pool.emplace_back(work);
    work();
    for (std::thread& t : pool)
        t.join();
    if (thrown) std::rethrow_exception(thrown);
    return out;
}

std::vector<Job> hidden_jobs(int first, int last) {
    return jobs_of(one_by_one(hidden_effects()), first, last, false);
}
std::vector<Job> foreign_jobs(int first, int last) {
    return jobs_of(one_by_one(foreign_effects()), first, last, false);
}
std::vector<Job> nothing_jobs(int first, int last) { return jobs_of({{}}, first, last, false); }
std::vector<Job> pair_jobs(int first, int last) { return jobs_of(pairs(), first, last, true); }

} // namespace blind
