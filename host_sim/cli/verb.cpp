#include "cli/verb.hpp"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>

namespace servoid::cli {

Argument Argument::required() const { return Argument(option_->required()); }
Argument Argument::positive() const { return Argument(option_->check(CLI::PositiveNumber)); }
Argument Argument::not_negative() const { return Argument(option_->check(CLI::NonNegativeNumber)); }
Argument Argument::between(int lower, int upper) const {
    return Argument(option_->check(CLI::Range(lower, upper)));
}
Argument Argument::one_of(const std::vector<std::string>& words) const {
    return Argument(option_->check(CLI::IsMember(words)));
}
Argument Argument::needs(const Argument& other) const {
    return Argument(option_->needs(other.option_));
}
Argument Argument::count(int values) const { return Argument(option_->expected(values)); }

Verb::Verb(CLI::App& app, const std::string& name, const std::string& meaning)
    : verb_(app.add_subcommand(name, meaning)) {}

Verb::Verb(const Verb& outer, const std::string& name, const std::string& meaning)
    : verb_(outer.verb_->require_subcommand(1)->add_subcommand(name, meaning)->fallthrough()) {}

Argument Verb::add_flag(const std::string& name, bool& value, const std::string& meaning) const {
    return Argument(verb_->add_flag(name, value, meaning));
}

template <class Value>
Argument Verb::add_option(const std::string& name, Value& value, const std::string& meaning) const {
    return Argument(verb_->add_option(name, value, meaning));
}
#define SERVOID_OPTION(...)                                                                        \
    template Argument Verb::add_option(const std::string&, __VA_ARGS__&, const std::string&) const;
SERVOID_OPTION(std::string)
SERVOID_OPTION(std::vector<std::string>)
SERVOID_OPTION(double)
SERVOID_OPTION(std::optional<double>)
SERVOID_OPTION(std::vector<double>)
SERVOID_OPTION(int)
SERVOID_OPTION(unsigned long)
SERVOID_OPTION(std::optional<std::uint64_t>)
#undef SERVOID_OPTION

Argument Verb::add_option_function(const std::string& name,
                                   const std::function<void(const std::string&)>& take,
                                   const std::string& meaning) const {
    return Argument(verb_->add_option_function(name, take, meaning));
}

void Verb::examples(const std::string& lines) const { verb_->footer("Examples:\n" + lines); }

void Verb::callback(const std::function<void()>& work) const { verb_->callback(work); }

} // namespace servoid::cli
