#include "common/file.hpp"

#include "common/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace servoid {

namespace {

constexpr off_t largest_file = off_t{2} << 30;

std::string last_error() { return std::strerror(errno); }

// An open file that is closed whatever happens.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    int get() const { return fd_; }
    // Network file systems report a full disk only here.
    bool close() {
        const int fd = fd_;
        fd_ = -1;
        return ::close(fd) == 0;
    }

  private:
    int fd_;
};

// Removes the temporary file unless the rename took it away.
class TemporaryFile {
  public:
    explicit TemporaryFile(std::string path) : path_(std::move(path)) {}
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    const std::string& path() const { return path_; }
    void keep() { path_.clear(); }

  private:
    std::string path_;
};

bool write_all(int fd, const std::string& content) {
    size_t done = 0;
    while (done < content.size()) {
        const ssize_t n = ::write(fd, content.data() + done, content.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        done += static_cast<size_t>(n);
    }
    return true;
}

// A link is written through: the file it points to is replaced, the link stays.
std::filesystem::path final_target(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) return path;
    auto target = std::filesystem::weakly_canonical(path, error);
    return error ? std::filesystem::path(path) : target;
}

// Devices and pipes (/dev/null, /dev/stdout) cannot be replaced by a rename.
bool write_in_place(const std::string& path, const std::string& content) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) return false;
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0 || !write_all(file.get(), content))
        throw FileError(path, 0, "cannot be written: " + last_error());
    return true;
}

mode_t mode_for(const std::string& target) {
    struct stat info {};
    if (::stat(target.c_str(), &info) == 0) return info.st_mode & 07777;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

void sync_folder(const std::filesystem::path& folder) {
    Descriptor handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    // The file itself is safe by now; a folder that cannot be flushed is no reason to fail.
    if (handle.get() >= 0) ::fsync(handle.get());
}

} // namespace

std::string read_file(const std::string& path) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) throw FileError(path, 0, "cannot be read: " + last_error());
    struct stat info {};
    if (::fstat(file.get(), &info) != 0)
        throw FileError(path, 0, "cannot be read: " + last_error());
    if (S_ISDIR(info.st_mode)) throw FileError(path, 0, "is a folder, a file was expected");
    if (info.st_size > largest_file)
        throw FileError(path, 0, "is larger than 2 GiB; split the capture");

    // One byte more than its size, so that the end is seen without another growth.
    std::string content(static_cast<size_t>(info.st_size) + 1, '\0');
    size_t done = 0;
    for (;;) {
        if (done == content.size()) content.resize(content.size() * 2);
        if (done > static_cast<size_t>(largest_file))
            throw FileError(path, 0, "is larger than 2 GiB; split the capture");
        const ssize_t n = ::read(file.get(), content.data() + done, content.size() - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) throw FileError(path, 0, "cannot be read: " + last_error());
        if (n == 0) break;
        done += static_cast<size_t>(n);
    }
    content.resize(done);
    return content;
}

void write_file(const std::string& path, const std::string& content) {
    if (path == "-") {
        if (std::fflush(stdout) != 0 || !write_all(STDOUT_FILENO, content))
            throw FileError("standard output", 0, "cannot be written: " + last_error());
        return;
    }
    std::error_code error;
    if (std::filesystem::is_directory(path, error))
        throw FileError(path, 0, "cannot be written: it is a folder");
    if (write_in_place(path, content)) return;

    const auto target = final_target(path);
    const auto folder = target.has_parent_path() ? target.parent_path() : ".";
    std::string pattern = (folder / ("." + target.filename().string() + ".XXXXXX")).string();
    Descriptor file(::mkostemp(pattern.data(), O_CLOEXEC));
    if (file.get() < 0) throw FileError(path, 0, "cannot be written: " + last_error());
    TemporaryFile temporary(pattern);
    if (!write_all(file.get(), content) || ::fchmod(file.get(), mode_for(target.string())) != 0 ||
        ::fsync(file.get()) != 0 || !file.close() ||
        ::rename(temporary.path().c_str(), target.c_str()) != 0)
        throw FileError(path, 0, "cannot be written: " + last_error());
    temporary.keep();
    sync_folder(folder);
}

} // namespace servoid
