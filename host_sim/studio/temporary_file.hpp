// Bytes that were sent, as a file for those who read files; gone when it goes out of scope.
#pragma once

#include <string>

namespace servoid::studio {

class TemporaryFile {
  public:
    // name: for its ending (".csv") only. Throws FileError.
    TemporaryFile(const std::string& name, const std::string& bytes);
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string folder_, path_;
};

} // namespace servoid::studio
