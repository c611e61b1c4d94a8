#include "studio/studio.hpp"

#include "common/error.hpp"
#include "common/file.hpp"
#include "plant/simulate.hpp"
#include "studio/actions.hpp"
#include "studio/state_json.hpp"
#include "studio/temporary_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace servoid::studio {

namespace {

constexpr size_t kMostSteps = 200; // each is a model and, at most, a diagnosis

std::string text_of(const Json& action, const char* key) {
    if (!action.contains(key) || !action[key].is_string() || action[key].get<std::string>().empty())
        throw UsageError(std::string("the action needs a text \"") + key + "\"");
    return action[key];
}

double number_of(const Json& action, const char* key) {
    if (!action.contains(key) || !action[key].is_number())
        throw UsageError(std::string("the action needs a number \"") + key + "\"");
    return action[key];
}

bool truth_of(const Json& action, const char* key) {
    if (!action.contains(key) || !action[key].is_boolean())
        throw UsageError(std::string("the action needs \"") + key + "\": true or false");
    return action[key];
}

size_t index_of(const Json& action) {
    const double index = number_of(action, "index");
    if (!(index >= 0) || index != std::floor(index) || index > 1e6)
        throw UsageError("index must be a whole number");
    return size_t(index);
}

Recordings shared(const std::vector<Recording>& recordings) {
    Recordings out;
    for (const Recording& r : recordings)
        out.push_back(std::make_shared<const Recording>(r));
    return out;
}

StepPtr opened(const Setup& setup) {
    Step step;
    step.what = "opened";
    step.model = setup.model;
    step.material = std::make_shared<const Material>(shared(setup.recordings), setup.motion);
    step.warnings = warnings_of(step.model, *step.material);
    return as_it_is(std::move(step));
}

DiagnoseOptions telling(const Progress& progress) {
    DiagnoseOptions out;
    out.progress = progress;
    return out;
}

double most(const std::vector<double>& values) {
    double out = 0;
    for (const double value : values)
        out = std::max(out, std::abs(value));
    return out;
}

std::string in_words(const SimulatedRun& run, const Model& model) {
    const Capture& c = run.capture;
    const auto [low, high] = std::minmax_element(c.position.begin(), c.position.end());
    return fmt::format("simulated: {:.3g} s, {:.3g} {} of travel, at most {:.3g} {}{}",
                       c.time_s.back() - c.time_s.front(), *high - *low,
                       unit_of(Quantity::position, model.motion), most(c.torque_ref),
                       unit_of(Quantity::torque, model.motion),
                       run.saturated ? ", at the torque limit" : "");
}

} // namespace

Studio::Studio(Setup setup) : setup_(std::move(setup)) {
    steps_.push_back(opened(setup_));
    worker_ = std::make_unique<Worker>([this] { changed(); },
                                       [this](const std::string& message) { failed(message); });
    look_again();
}

StepPtr Studio::now() const {
    const std::lock_guard lock(mutex_);
    return steps_[at_];
}

long Studio::revision() const {
    const std::lock_guard lock(mutex_);
    return revision_;
}

void Studio::changed() {
    const std::lock_guard lock(mutex_);
    ++revision_;
    wake_.notify_all();
}

void Studio::wake() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    changed();
}

void Studio::failed(const std::string& message) {
    const std::lock_guard lock(mutex_);
    error_ = message;
}

void Studio::push(StepPtr step) {
    const std::lock_guard lock(mutex_);
    steps_.resize(at_ + 1); // what was undone is gone
    steps_.push_back(std::move(step));
    if (steps_.size() > kMostSteps) steps_.erase(steps_.begin() + 1);
    at_ = steps_.size() - 1;
    error_.clear();
    ++story_revision_;
}

void Studio::replace(const StepPtr& old, StepPtr step) {
    const std::lock_guard lock(mutex_);
    const auto place = std::find(steps_.begin(), steps_.end(), old);
    if (place == steps_.end()) return;
    *place = std::move(step);
    error_.clear();
    ++story_revision_;
}

void Studio::change(const std::string& what, Change change) {
    worker_->queue(what, [this, change = std::move(change)](const Progress& progress) {
        push(change(*now(), progress));
    });
}

void Studio::improve(const std::string& what, Change improve, bool dispensable) {
    worker_->queue(
        what,
        [this, improve = std::move(improve)](const Progress& progress) {
            const StepPtr from = now();
            replace(from, improve(*from, progress));
        },
        dispensable);
}

void Studio::diagnose_now(bool dispensable) {
    improve(
        "diagnose",
        [](const Step& from, const Progress& progress) {
            return diagnosed(from, telling(progress));
        },
        dispensable);
}

void Studio::look_again() {
    if (setup_.diagnose_at_once) diagnose_now(true);
}

void Studio::stop(const Json&) { worker_->stop(); }

void Studio::walk(const Json& action) {
    const std::string name = action["action"];
    worker_->queue(name, [this, back = name == "undo"](const Progress&) {
        const std::lock_guard lock(mutex_);
        if (back ? at_ == 0 : at_ + 1 >= steps_.size()) return;
        back ? --at_ : ++at_;
        error_.clear();
        ++story_revision_;
    });
}

StepPtr Studio::with_more(const Step& from, Recordings more, const std::string& what) const {
    Recordings all = from.material->recordings();
    all.insert(all.end(), more.begin(), more.end());
    return with_material(from, std::make_shared<const Material>(all, setup_.motion), what);
}

void Studio::take(Recordings more, const std::string& what) {
    change(what, [this, more = std::move(more), what](const Step& from, const Progress&) {
        return with_more(from, more, what);
    });
}

void Studio::show_bus(bool running, const BusView& view) {
    const std::lock_guard lock(mutex_);
    driving_ = running;
    bus_view_ = view;
    ++revision_;
    wake_.notify_all();
}

// What was heard is kept, however the run ends.
void Studio::drive_and_take(const Experiment& experiment, const Progress& progress) {
    BusView last;
    show_bus(true, last);
    const BusRun run =
        run_on_bus(setup_.bus, experiment, [&](const RunProgress& p, const BusView& view) {
            last = view;
            show_bus(true, view);
            try {
                progress(p.what, p.share);
            } catch (...) { // stopped: first the drive, then the work
                return false;
            }
            return true;
        });
    show_bus(false, last);
    Recordings more;
    for (const Capture& capture : run.captures) {
        Recording r{capture, {}, true};
        r.capture.path = fmt::format("{}-{}.csv", setup_.bus.interface, ++runs_);
        r.source = source_of(r.capture.path, format_capture_csv(capture));
        more.push_back(std::make_shared<const Recording>(std::move(r)));
    }
    if (!more.empty()) push(with_more(*now(), more, "with " + more.front()->capture.path));
    if (!run.fault.empty()) throw can::BusError(run.fault);
}

void Studio::run_drive(const Json& action) {
    if (setup_.bus.interface.empty())
        throw UsageError("no drive: start the studio with --can INTERFACE");
    const Experiment experiment = parse_experiment(text_of(action, "experiment"));
    worker_->queue("run", [this, experiment](const Progress& progress) {
        drive_and_take(experiment, progress);
    });
}

// A message names what was sent, not where it lies meanwhile.
std::vector<Capture> Studio::read_sent(const std::string& name, const std::string& bytes) const {
    const TemporaryFile file(name, bytes);
    try {
        return setup_.read(file.path());
    } catch (const Error& e) {
        std::string message = e.what();
        for (size_t at; (at = message.find(file.path())) != std::string::npos;)
            message.replace(at, file.path().size(), name);
        throw UsageError(message);
    }
}

long Studio::add_capture(const std::string& name, std::string bytes) {
    Recordings more;
    for (Capture& capture : read_sent(name, bytes)) {
        Recording r{std::move(capture), source_of(name, bytes), true};
        r.capture.path = name;
        more.push_back(std::make_shared<const Recording>(std::move(r)));
    }
    const long before = revision();
    take(std::move(more), "with " + name);
    return before;
}

void Studio::turn_capture(const Json& action) {
    const std::string file = text_of(action, "file");
    const bool on = truth_of(action, "on");
    const std::string what = (on ? "with " : "without ") + file;
    change(what, [this, file, on, what](const Step& from, const Progress&) {
        Recordings all = from.material->recordings();
        for (auto& r : all)
            if (r->capture.path == file) {
                Recording turned = *r;
                turned.on = on;
                r = std::make_shared<const Recording>(std::move(turned));
            }
        return with_material(from, std::make_shared<const Material>(all, setup_.motion), what);
    });
}

// What the recommended move would ask of the drive, by the most probable model.
void Studio::simulate_next(const Json&) {
    worker_->queue("simulate", [this](const Progress&) {
        const StepPtr step = now();
        if (!step->diagnosis || !step->diagnosis->next)
            throw UsageError("no experiment is recommended: diagnose first");
        const Model& model = step->diagnosis->candidates.front().fit.model;
        if (!model.controller)
            throw UsageError("the model has no [controller]: its drive cannot be simulated");
        const Experiment experiment = parse_experiment(step->diagnosis->next->experiment);
        const std::string preview = in_words(simulate_run(model, experiment, 1), model);
        const std::lock_guard lock(mutex_);
        preview_ = {step, preview};
    });
}

void Studio::add_term(const Json& action) {
    if (action.contains("law")) {
        const std::string law = text_of(action, "law"), called = text_of(action, "name");
        change("add custom." + called,
               [=](const Step& from, const Progress&) { return add_law(from, called, law); });
    } else {
        const std::string effect = text_of(action, "effect");
        change("add " + effect,
               [=](const Step& from, const Progress&) { return add(from, effect); });
    }
    look_again();
}

void Studio::change_term(const Json& action) {
    const std::string name = action["action"];
    const size_t index = index_of(action);
    if (name == "remove") {
        change(name, [=](const Step& from, const Progress&) { return remove(from, index); });
        return;
    }
    const bool on = truth_of(action, "on");
    change("fit", [=](const Step& from, const Progress&) { return turn(from, index, on); });
}

void Studio::change_parameter(const Json& action) {
    const std::string name = action["action"], which = text_of(action, "name");
    if (name == "set") {
        const double value = number_of(action, "value");
        change(name, [=](const Step& from, const Progress&) { return set(from, which, value); });
        return;
    }
    const bool fixed = truth_of(action, "fixed");
    change(name, [=](const Step& from, const Progress&) { return fix(from, which, fixed); });
}

void Studio::compute(const Json& action) {
    const std::string name = action["action"];
    if (name == "fit")
        change(name, [](const Step& from, const Progress&) { return fit_again(from); });
    else if (name == "refine")
        change(name, [](const Step& from, const Progress& progress) {
            return refined(from, telling(progress));
        });
    else
        diagnose_now(false);
}

long Studio::act(const Json& action) {
    using Do = void (Studio::*)(const Json&);
    static const std::map<std::string, Do> actions = {{"add", &Studio::add_term},
                                                      {"remove", &Studio::change_term},
                                                      {"turn", &Studio::change_term},
                                                      {"set", &Studio::change_parameter},
                                                      {"fix", &Studio::change_parameter},
                                                      {"fit", &Studio::compute},
                                                      {"diagnose", &Studio::compute},
                                                      {"refine", &Studio::compute},
                                                      {"undo", &Studio::walk},
                                                      {"redo", &Studio::walk},
                                                      {"capture", &Studio::turn_capture},
                                                      {"experiment", &Studio::simulate_next},
                                                      {"run", &Studio::run_drive},
                                                      {"stop", &Studio::stop}};
    const std::string name = text_of(action, "action");
    const auto found = actions.find(name);
    if (found == actions.end()) throw UsageError("there is no action " + name);
    const long before = revision();
    (this->*found->second)(action);
    return before;
}

Json Studio::history_json() const {
    Json out = Json::array();
    for (size_t i = 0; i <= at_; ++i)
        out.push_back(
            {{"what", steps_[i]->what}, {"torque_error", number(steps_[i]->torque_error)}});
    return out;
}

Json Studio::bus_json() const {
    if (setup_.bus.interface.empty()) return nullptr;
    const can::LiveRows& live = bus_view_.live;
    return {
        {"interface", setup_.bus.interface},
        {"running", driving_},
        {"rows", bus_view_.rows},
        {"seconds", bus_view_.seconds},
        {"live", {{"time_s", live.time_s}, {"torque", live.torque}, {"position", live.position}}}};
}

Json Studio::experiment_json(const Step& step) const {
    if (!step.diagnosis || !step.diagnosis->next) return nullptr;
    return {{"experiment", step.diagnosis->next->experiment},
            {"reason", step.diagnosis->next->reason},
            {"preview", preview_.first.get() == &step ? Json(preview_.second) : Json(nullptr)}};
}

Json Studio::state(long after, std::chrono::milliseconds wait) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, wait, [&] { return closing_ || revision_ > after; });
    const StepPtr step = steps_[at_];
    Json out = {{"schema", "servoid.studio/1"},
                {"revision", revision_},
                {"story_revision", story_revision_},
                {"busy", busy_json(worker_->busy())},
                {"error", error_.empty() ? Json(nullptr) : Json(error_)},
                {"undo", at_ > 0 ? Json(step->what) : Json(nullptr)},
                {"redo", at_ + 1 < steps_.size() ? Json(steps_[at_ + 1]->what) : Json(nullptr)},
                {"history", history_json()},
                {"experiment", experiment_json(*step)},
                {"can", bus_json()}};
    lock.unlock();
    out["model"] = terms_json(*step);
    out["captures"] = recordings_json(step->material->recordings());
    out["effects"] = effects_json(step->model);
    return out;
}

std::shared_ptr<const Json> Studio::story() {
    const std::lock_guard one_at_a_time(telling_);
    const StepPtr step = now();
    if (told_.step != step) {
        Provenance provenance{{setup_.model_source}, setup_.commands};
        for (const SourceFile& source : step->material->sources())
            provenance.files.push_back(source);
        told_.story = std::make_shared<const Json>(story_of(*step, setup_.model, provenance));
        told_.step = step;
    }
    return told_.story;
}

std::string Studio::model_toml() const { return format_model(now()->model); }

} // namespace servoid::studio
