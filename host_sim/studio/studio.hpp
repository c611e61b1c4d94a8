// A session with a model and its captures: what several tabs look at and act on.
//
// Threads    Every function may be called by any thread. One worker does what takes time.
// State      One consistent state at any time, numbered by a revision that grows with every change.
#pragma once

#include "studio/bus_run.hpp"
#include "studio/step.hpp"
#include "studio/worker.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace servoid::studio {

struct Setup {
    Model model;
    SourceFile model_source;
    std::vector<Recording> recordings;
    MotionOptions motion;
    std::vector<std::string> commands; // that led here, for the provenance
    std::function<std::vector<Capture>(const std::string& path)> read; // of one that was sent
    BusSetup bus;
    bool diagnose_at_once = true; // what is new, until something else is asked for
};

class Studio {
  public:
    // Throws Refusal where a capture cannot be what it says.
    explicit Studio(Setup setup);

    // servoid.studio/1 as soon as its revision is beyond `after`, at the latest after `wait`.
    Json state(long after, std::chrono::milliseconds wait);
    // servoid.story/1; computed once for all who ask.
    std::shared_ptr<const Json> story();
    std::string model_toml() const;

    // {"action": ...}; returns the revision before it: what it changes has a higher one. What takes
    // time goes on afterwards. Throws UsageError.
    long act(const Json& action);
    // A capture that was sent; the name is for people only.
    long add_capture(const std::string& name, std::string bytes);
    // Whoever waits for a state is answered at once; for the end of the program.
    void wake();

  private:
    struct Told {
        StepPtr step;
        std::shared_ptr<const Json> story;
    };
    using Change = std::function<StepPtr(const Step&, const Progress&)>;

    StepPtr now() const;
    long revision() const;
    void change(const std::string& what, Change change);                     // a step more
    void improve(const std::string& what, Change improve, bool dispensable); // of the same step
    void push(StepPtr step);
    void replace(const StepPtr& old, StepPtr step);
    void changed();
    void failed(const std::string& message);
    void diagnose_now(bool dispensable);
    void look_again();
    void take(Recordings more, const std::string& what);
    StepPtr with_more(const Step& from, Recordings more, const std::string& what) const;
    void drive_and_take(const Experiment& experiment, const Progress& progress);
    void show_bus(bool running, const BusView& view);
    std::vector<Capture> read_sent(const std::string& name, const std::string& bytes) const;

    // The actions.
    void add_term(const Json& action);
    void change_term(const Json& action);
    void change_parameter(const Json& action);
    void compute(const Json& action);
    void walk(const Json& action);
    void turn_capture(const Json& action);
    void simulate_next(const Json& action);
    void run_drive(const Json& action);
    void stop(const Json& action);

    Json history_json() const;
    Json bus_json() const;
    Json experiment_json(const Step& step) const;

    const Setup setup_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    long revision_ = 1, story_revision_ = 1;
    bool closing_ = false;
    std::string error_;
    std::vector<StepPtr> steps_; // opened first
    size_t at_ = 0;
    bool driving_ = false;
    int runs_ = 0; // on the bus
    BusView bus_view_;
    std::pair<StepPtr, std::string> preview_; // of the experiment that was simulated
    std::mutex telling_;
    Told told_;
    std::unique_ptr<Worker> worker_; // last: ends before what it works on
};

} // namespace servoid::studio
