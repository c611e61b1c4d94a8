// A law of one's own, from the command line to the model file and back.
#include "cli/run_program.hpp"

using namespace servoid::cli_test;

namespace {

const std::string move = "trapezoid:stroke=6.28,velocity=40,acceleration=1500,cycles=4";

std::string model_with_law(const Folder& folder, const std::string& law,
                           const std::string& parameters) {
    const std::string path = folder / "truth.toml";
    std::ofstream(path) << text_of(example("system1.toml")) << "\n[effects.custom.x]\nlaw = \""
                        << law << "\"\n\n[effects.custom.x.parameters]\n"
                        << parameters << "\n";
    return path;
}

TEST(AddCustom, IsFittedAndWrittenAndReadByEveryVerb) {
    const Folder folder;
    const std::string truth = model_with_law(folder, "k*theta^3", "k = 1e-4");
    const std::string csv = simulated(folder, truth, move, "a.csv");
    const std::string better = folder / "better.toml";
    const Json json = json_of(run({"add", "custom.cubic=k*theta^3", example("system1.toml"), csv,
                                   "--out", better, "--json"}));
    EXPECT_EQ(json.at("effect"), "custom.cubic");
    EXPECT_LT(json.at("error_after").get<double>(), 0.02);
    const Json& k = json.at("model_parameters").at("custom.cubic.k");
    EXPECT_NEAR(k.at("value").get<double>(), 1e-4, 1e-6);
    EXPECT_GT(k.at("std").get<double>(), 0);
    EXPECT_EQ(k.at("unit"), "");
    const Json& table = json.at("model").at("effects").at("custom").at("cubic");
    EXPECT_EQ(table.at("law"), "k*theta^3");
    EXPECT_EQ(table.at("parameters").at("k"), k.at("value"));
    EXPECT_NE(text_of(better).find("[effects.custom.cubic]\nlaw = \"k*theta^3\"\n\n"
                                   "[effects.custom.cubic.parameters]\nk = "),
              std::string::npos)
        << text_of(better);
    const Json compared = json_of(run({"compare", better, csv, "--json"}));
    EXPECT_LT(compared.at("torque_error").get<double>(), 0.02);
    EXPECT_LT(compared.at("loop").at("torque_error").get<double>(), 0.1);
    EXPECT_EQ(json_of(run({"diagnose", better, csv, "--json"})).at("verdict"), "adequate");
    const std::string sine = simulated(folder, better, "sine", "sine.csv");
    for (const auto& command :
         {std::vector<std::string>{"identify", sine, "--model", better},
          std::vector<std::string>{"sweep", better, "--from", "50", "--to", "100", "--step", "50"},
          std::vector<std::string>{"refine", better, csv, "--quiet"}}) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.code, 0) << command.front() << ended.err;
    }
}

// From n = 1 no descent leads to 7.
TEST(AddCustom, StartValuesFollowTheLaw) {
    const Folder folder;
    const std::string truth = model_with_law(folder, "k*sin(n*theta)", "k = 5e-3\nn = 7");
    const std::string csv = simulated(folder, truth, move, "a.csv");
    const Ended ended = run({"add", "custom.s=k*sin(n*theta);n=6.8", example("system1.toml"), csv});
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find(" with custom.s ("), std::string::npos) << ended.out;
    const Json json = json_of(
        run({"add", "custom.s=k*sin(n*theta) ; n = 6.8", example("system1.toml"), csv, "--json"}));
    EXPECT_NEAR(json.at("model_parameters").at("custom.s.n").at("value").get<double>(), 7, 0.01);
}

// What stands behind "to add it: " in the advice.
std::string advised_command(const Json& diagnosis) {
    const std::string advice = diagnosis.at("advice");
    const size_t at = advice.find("servoid add ");
    return at == std::string::npos ? "" : advice.substr(at);
}

Ended pasted(const std::string& command, const Folder& folder) {
    std::ofstream(folder / "paste") << "cd " << quoted(folder / ".") << "\nservoid() { "
                                    << quoted(SERVOID_PROGRAM) << " \"$@\"; }\n"
                                    << command << "\n";
    const int status = std::system(("sh " + quoted(folder / "paste") + " >" +
                                    quoted(folder / "out") + " 2>" + quoted(folder / "err"))
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out"),
            text_of(folder / "err")};
}

// The model has a law of that name already, the file's name needs quotes.
TEST(AddCustom, AsDiagnoseAdvisesIt) {
    const Folder folder;
    const std::string truth = model_with_law(folder, "k*theta^3", "k = 1e-4");
    const std::string csv =
        simulated(folder, truth, "trapezoid:stroke=6.283185307,torque_noise=1e-3", "it's a.csv");
    const std::string known = folder / "known.toml";
    std::ofstream(known) << text_of(example("system1.toml"))
                         << "[effects.custom.cubic]\nlaw = \"k*sin(40*t)\"\n"
                            "[effects.custom.cubic.parameters]\nk = 0\n";
    const Json found = json_of(run({"diagnose", known, csv, "--band", "90", "--json"}));
    const std::string command = advised_command(found);
    EXPECT_TRUE(command.starts_with("servoid add 'custom.cubic2=k0+")) << found.at("advice");
    EXPECT_NE(command.find(" --band 90 "), std::string::npos) << command;
    const Ended ended = pasted(command, folder);
    EXPECT_EQ(ended.code, 0) << command << ended.err;
    const Json compared =
        json_of(run({"compare", folder / "with_cubic2.toml", csv, "--band", "90", "--json"}));
    EXPECT_GT(found.at("error_before").get<double>(), 0.2);
    EXPECT_LT(compared.at("torque_error").get<double>(), 0.03);
}

TEST(AddCustom, WrongUsageEndsWith2) {
    const Folder folder;
    const std::string truth = model_with_law(folder, "k*theta^3", "k = 1e-4");
    const std::string csv = simulated(folder, truth, move, "a.csv");
    const std::vector<std::pair<std::string, std::string>> wrong = {
        {"custom", "custom needs a name and a law; expected for example 'custom.cubic="},
        {"custom.s=k*sinh(v)", "unknown function \"sinh\""},
        {"custom.s=k*v;c=1", "no parameter \"c\""},
        {"custom.x=k*v", "custom.x cannot be added: the model has it already"},
    };
    for (const auto& [argument, message] : wrong) {
        const Ended ended = run({"add", argument, truth, csv});
        EXPECT_EQ(ended.code, 2) << argument;
        EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
    }
}

TEST(AddCustom, WhatTheMotionCannotAnswerEndsWith4) {
    const Folder folder;
    const std::string csv = simulated(folder, example("system1.toml"), move, "a.csv");
    for (const char* law : {"custom.s=k*sqrt(theta-100)", "custom.s=p*q*v", "custom.s=k*a"}) {
        const Ended ended = run({"add", law, example("system1.toml"), csv});
        EXPECT_EQ(ended.code, 4) << law << ended.err;
        EXPECT_NE(ended.err.find("record instead: "), std::string::npos) << ended.err;
    }
    const std::string truth = model_with_law(folder, "k*sqrt(1-theta)", "k = 1e-4");
    const Ended ended = run({"simulate", truth, "--experiment", move, "--out", folder / "b.csv"});
    EXPECT_EQ(ended.code, 4);
    EXPECT_NE(ended.err.find("custom.x = k*sqrt(1-theta) has no finite value at theta = 1"),
              std::string::npos)
        << ended.err;
}

TEST(Effects, CustomComesWithAnExample) {
    const Ended ended = run({"effects", "custom"});
    EXPECT_EQ(ended.code, 0);
    EXPECT_NE(ended.out.find("    [effects.custom.cubic]\n    law = \"k*theta^3\""),
              std::string::npos)
        << ended.out;
    EXPECT_TRUE(json_of(run({"effects", "custom", "--json"})).at("example").is_string());
}

} // namespace
