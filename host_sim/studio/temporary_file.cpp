#include "studio/temporary_file.hpp"

#include "common/error.hpp"
#include "common/file.hpp"
#include "common/text.hpp"

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace servoid::studio {

namespace {

// One of those that captures have; the name itself never becomes a path.
std::string ending_of(const std::string& name) {
    for (const char* ending : {".mat", ".log"})
        if (lower_case(name).ends_with(ending)) return ending;
    return ".csv";
}

} // namespace

TemporaryFile::TemporaryFile(const std::string& name, const std::string& bytes) {
    std::string pattern = (std::filesystem::temp_directory_path() / "servoid-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw FileError(pattern, 0, "cannot make a temporary folder");
    folder_ = pattern;
    path_ = folder_ + "/capture" + ending_of(name);
    write_file(path_, bytes);
}

TemporaryFile::~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

} // namespace servoid::studio
