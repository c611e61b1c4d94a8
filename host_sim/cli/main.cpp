#include "cli/app.hpp"

int main(int argc, char** argv) { return servoid::cli::run(argc, argv); }
