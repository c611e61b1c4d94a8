// What a story was made of, so that it can be made again.
#pragma once

#include "answers/json.hpp"

#include <string>
#include <vector>

namespace servoid {

struct SourceFile {
    std::string file; // as it was named
    std::string sha256;
    unsigned long bytes = 0;
};
// Throws FileError.
SourceFile source_file(const std::string& path);
SourceFile source_of(const std::string& name, const std::string& content);

struct Provenance {
    std::vector<SourceFile> files;
    std::vector<std::string> commands;
};

// With this program's version and the date (UTC; that of SOURCE_DATE_EPOCH where it is set).
Json provenance_json(const Provenance& provenance);

} // namespace servoid
