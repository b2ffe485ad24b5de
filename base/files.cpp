#include "base/files.h"

#include "base/error.h"
#include "base/limits.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace shadowbench {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void failToWrite(const fs::path& file, std::string_view reason, Failure failure) {
    throw InternalError(fmt::format("cannot write {}: {}; free some space or choose another place", file.string(), reason),
                        failure);
}

[[noreturn]] void failToWrite(const fs::path& file, int errorNumber) {
    failToWrite(file, std::strerror(errorNumber), failureOf(errorNumber));
}

/// A file of its own name beside `target`, removed again unless it was renamed to its target.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& target) : target_(target) {
        const std::string extension = target.extension().string();
        std::string name = (target.parent_path() / fmt::format(".{}.XXXXXX{}", target.stem().string(), extension)).string();
        const int descriptor = ::mkstemps(name.data(), static_cast<int>(extension.size()));
        if (descriptor < 0) failToWrite(target, errno);
        ::fchmod(descriptor, 0644); // mkstemps makes it private to its owner
        ::close(descriptor);
        path_ = name;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }

    [[nodiscard]] const fs::path& path() const { return path_; }

    void moveToTarget() {
        flush();
        if (::rename(path_.c_str(), target_.c_str()) != 0) failToWrite(target_, errno);
        path_.clear();
    }

private:
    void flush() const {
        const int descriptor = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
        if (descriptor < 0) failToWrite(target_, errno);
        const int failed = ::fsync(descriptor) == 0 ? 0 : errno;
        ::close(descriptor);
        if (failed != 0) failToWrite(target_, failed);
    }

    fs::path target_, path_;
};

void writeWhole(const fs::path& path, const fs::path& target, std::string_view content) {
    std::FILE* stream = std::fopen(path.c_str(), "wb");
    if (stream == nullptr) failToWrite(target, errno);
    int failed = std::fwrite(content.data(), 1, content.size(), stream) == content.size() ? 0 : errno;
    if (std::fclose(stream) != 0 && failed == 0) failed = errno;
    if (failed != 0) failToWrite(target, failed);
}

/// Insertions, deletions, replacements and swaps of neighbours (optimal string alignment).
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                cost[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            cost[i][j] = std::min({replaced, cost[i - 1][j] + 1, cost[i][j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    }
    return cost.back().back();
}

} // namespace

void writeFile(const fs::path& file, std::string_view content) {
    writeFileWith(file, [&](const fs::path& path) { writeWhole(path, file, content); });
}

void writeFileWith(const fs::path& file, const std::function<void(const fs::path&)>& write) {
    std::error_code failure, ignored;
    // Renaming would replace a device or a pipe by a file of the same name. Asked once: another process may remove it.
    const fs::file_status there = fs::status(file, ignored);
    if (fs::exists(there) && !fs::is_regular_file(there))
        failToWrite(file, "it exists and is not a regular file", Failure::Lasting);
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), failure);
    if (failure) failToWrite(file, failure.value());
    TemporaryFile temporary(file);
    write(temporary.path());
    temporary.moveToTarget();
}

std::string readFile(const fs::path& file) {
    std::error_code failure;
    if (fs::is_directory(file, failure))
        throw BadInput(fmt::format("cannot read {}: it is a folder; name a file", file.string()));
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    const std::uint64_t most = limitOf(Limit::TextMib) << 20U; // of a device there is no end
    std::string text;
    for (std::array<char, 1 << 16> block{}; stream.good();) {
        stream.read(block.data(), block.size());
        text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
        if (text.size() > most)
            throw BadInput(fmt::format("cannot read {}: it has {} bytes and more, {}", file.string(), text.size(),
                                       beyond(Limit::TextMib)));
    }
    if (!stream.is_open() || stream.bad())
        throw BadInput(fmt::format("cannot read {}: {}", file.string(), std::strerror(errno != 0 ? errno : EIO)));
    return text;
}

std::string didYouMean(std::string_view word, const std::vector<std::string>& known) {
    const std::size_t limit = std::max<std::size_t>(1, word.size() / 3);
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& candidate : known) {
        // Of a word that is far too long the distance would take long, too.
        if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) > limit) continue;
        if (const std::size_t distance = editDistance(word, candidate); distance <= limit)
            near.emplace_back(distance, candidate);
    }
    if (near.empty()) return "";
    std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string words = fmt::format("\"{}\"", near.front().second);
    for (std::size_t i = 1; i < std::min<std::size_t>(near.size(), 3); ++i)
        words += fmt::format(" or \"{}\"", near[i].second);
    return fmt::format(" (did you mean {}?)", words);
}

} // namespace shadowbench
