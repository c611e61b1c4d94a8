// What identify and replay have in common: their options and their answer.
#pragma once

#include "cli/app.hpp"
#include "identify/identify.hpp"

namespace servoid::cli {

struct IdentifyArguments {
    std::string model, method = "cubic";
    std::vector<double> frequencies, window;
    std::string input; // "", "ref", "measured"

    std::optional<Model> read_model() const; // nothing where none was named
    IdentifyOptions options(const Model* model) const;
};

void add_identify_options(const Verb& verb, IdentifyArguments& arguments);

// Every frequency of every capture, by the firmware core.
std::vector<Identification> identify_all(const std::vector<Capture>& captures,
                                         const IdentifyOptions& options);
// The answer of all together, as schema servoid.identify/1 says, and as text.
Json identification_json(const std::vector<Identification>& all, const Capture& capture);
void print_identification(const Output& out, const std::vector<Identification>& all,
                          const Capture& capture);

} // namespace servoid::cli
