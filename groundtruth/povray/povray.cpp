#include "groundtruth/povray/povray.h"

#include "groundtruth/povray/channels.h"
#include "groundtruth/povray/scene_text.h"

#include "base/error.h"
#include "base/image_io.h"
#include "base/process.h"
#include "base/progress.h"
#include "base/temporary_folder.h"

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <mutex>
#include <system_error>
#include <utility>

namespace shadowbench::groundtruth::povray {
namespace {

constexpr const char* sceneName = "scene.pov";
constexpr const char* imageName = "image.png";
constexpr std::size_t longestMessage = 300; // of POV-Ray's, in our one sentence

/// Gathers what matters of POV-Ray's messages: the progress and the first line that names an error.
class Messages {
public:
    explicit Messages(const Progress& progress) : progress_(progress) {}

    void operator()(std::string_view line) {
        if (isProgress(line)) return;
        if (continues_ && line.starts_with(' ')) { // POV-Ray wraps at 80 columns and indents the rest by one
            if (error_.size() < longestMessage) error_ += line;
            return;
        }
        continues_ = error_.empty() && isError(line);
        if (continues_) error_ = line;
        if (!line.empty()) last_ = line;
    }

    /// The first error line, else the last line of all; bounded, printable.
    [[nodiscard]] std::string relevant() const {
        std::string text = (error_.empty() ? last_ : error_).substr(0, longestMessage);
        for (char& c : text)
            if (static_cast<unsigned char>(c) < ' ') c = ' ';
        return text.empty() ? "no message" : text;
    }

private:
    bool isProgress(std::string_view line) const {
        long done = 0, all = 0;
        if (std::sscanf(std::string(line).c_str(), "Rendered %ld of %ld pixels", &done, &all) != 2) return false;
        if (progress_ && all > 0) progress_(static_cast<double>(done) / static_cast<double>(all), "POV-Ray");
        return true;
    }
    static bool isError(std::string_view line) {
        if (line.find("user configuration file") != line.npos) return false; // absent by intent: HOME is private
        return line.find("rror") != line.npos || line.find("annot") != line.npos;
    }

    const Progress& progress_;
    std::string error_, last_;
    bool continues_ = false;
};

std::filesystem::path program(const Options& options) {
    if (const auto found = findProgram(options.program)) return *found;
    throw Inconclusive(
        fmt::format("cannot compute soft shadows: the program {} is missing; install it with apt-get install povray",
                    options.program.string()));
}

/// Several times what POV-Ray 3.7 takes for its threads, the scene's text and the pixels: a render that needs more is stuck.
std::uintmax_t memoryLimit(std::size_t textBytes, glm::ivec2 size, int threads) {
    constexpr std::uintmax_t mebibyte = 1 << 20;
    const std::uintmax_t pixels = std::uintmax_t{1} * static_cast<unsigned>(size.x) * static_cast<unsigned>(size.y);
    return 1024 * mebibyte + 160 * mebibyte * static_cast<unsigned>(threads) + 20 * textBytes + 160 * pixels;
}

bool diskIsFull(const std::filesystem::path& folder) {
    constexpr std::uintmax_t little = 64 * 1024;
    std::error_code error;
    const std::filesystem::space_info space = std::filesystem::space(folder, error);
    return !error && space.available < little;
}

[[noreturn]] void throwDiskFull(const std::filesystem::path& folder) {
    throw Inconclusive(fmt::format("POV-Ray could not render: the disk of {} is full; free some space or set TMPDIR",
                                   folder.parent_path().string()),
                       Failure::Transient);
}

void writeScene(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (stream) return;
    if (diskIsFull(file.parent_path())) throwDiskFull(file.parent_path());
    throw Inconclusive(fmt::format("cannot write the POV-Ray scene in {}: {}", file.parent_path().parent_path().string(),
                                   std::generic_category().message(errno)));
}

void requireSuccess(const Finished& finished, const Messages& messages, const Command& command) {
    const double seconds = std::chrono::duration<double>(command.limit).count();
    if (finished.timedOut)
        throw Inconclusive(
            fmt::format("POV-Ray was stopped after its limit of {:g} s; ask for fewer samples or pixels", seconds),
            Failure::Transient);
    if (finished.signal == 0 && finished.exitCode == 0) return;
    if (diskIsFull(command.folder)) throwDiskFull(command.folder);
    if (finished.signal != 0)
        throw Inconclusive(fmt::format("POV-Ray was killed by signal {} ({}): {}; run it again", finished.signal,
                                       strsignal(finished.signal), messages.relevant()),
                           Failure::Transient);
    throw Inconclusive(
        fmt::format("POV-Ray failed with exit code {}: {}; run it again", finished.exitCode, messages.relevant()),
        Failure::Transient);
}

/// A channel holds k/unit for a whole k ≤ most; anything else means that POV-Ray did not render the scene that was written.
Image<int> counts(const Image<float>& channel, double unit, int most) {
    constexpr double tolerance = 0.25; // of one sample; PNG16's rounding is at most 0.13 at mostLightSamples
    Image<int> result(channel.width(), channel.height());
    for (std::size_t i = 0; i < channel.size(); ++i) {
        const double value = channel[i] * unit;
        const double count = std::rint(value);
        if (!(std::abs(value - count) <= tolerance) || count < 0 || count > most)
            throw Inconclusive(fmt::format("POV-Ray's image is not a count of light samples: {:g} of {}", value, most));
        result[i] = static_cast<int>(count);
    }
    return result;
}

Image<float> fraction(const Image<int>& visible, int samples) {
    Image<float> result(visible.width(), visible.height());
    for (std::size_t i = 0; i < visible.size(); ++i)
        result[i] = static_cast<float>(static_cast<double>(visible[i]) / samples);
    return result;
}

/// Whether the file ends as a PNG must (the IEND chunk): libpng reports a torn one on stderr in its own words.
bool isWholePng(const std::filesystem::path& file) {
    using namespace std::string_view_literals;
    constexpr std::string_view end = "\0\0\0\0IEND\xAE\x42\x60\x82"sv;
    std::ifstream stream(file, std::ios::binary);
    std::string tail(end.size(), ' ');
    stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    stream.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    return stream && tail == end;
}

Image<float> readImage(const std::filesystem::path& file, int channel, glm::ivec2 size) {
    if (isWholePng(file)) {
        Image<float> image = readChannel(file, channel);
        if (image.width() == size.x && image.height() == size.y) return image;
    }
    if (diskIsFull(file.parent_path())) throwDiskFull(file.parent_path());
    throw Inconclusive("POV-Ray ended without a complete image; run it again", Failure::Transient);
}

/// Blue without the hit mask's share, which goes to `hit`.
Image<float> takeHitMask(Image<float> blue, Image<std::uint8_t>& hit) {
    constexpr auto mask = static_cast<float>(hitMask);
    hit = Image<std::uint8_t>(blue.width(), blue.height());
    for (std::size_t i = 0; i < blue.size(); ++i) {
        if (blue[i] < 0.5F * mask) continue;
        hit[i] = 1;
        blue[i] -= mask;
    }
    return blue;
}

/// Channels that count the samples of the three parts.
Render decodePoints(const Image<float>& red, const Image<float>& green, const Image<float>& blue, int samples) {
    const SampleParts parts = sampleParts(samples);
    const double quarter = std::bit_ceil(static_cast<unsigned>(parts.firstQuarter)); // units as in addPoints
    const double half = 2.0 * std::bit_ceil(static_cast<unsigned>(parts.secondHalf));
    const Image<int> firstQuarter = counts(red, quarter, parts.firstQuarter);
    const Image<int> secondQuarter = counts(green, quarter, parts.secondQuarter);
    const Image<int> secondHalf = counts(blue, half, parts.secondHalf);

    Image<int> firstHalf = firstQuarter, all = firstQuarter;
    for (std::size_t i = 0; i < all.size(); ++i) {
        firstHalf[i] += secondQuarter[i];
        all[i] = firstHalf[i] + secondHalf[i];
    }
    return {fraction(all, samples),
            fraction(firstHalf, parts.firstQuarter + parts.secondQuarter),
            fraction(firstQuarter, parts.firstQuarter),
            {},
            0};
}

/// Channels that hold visible fractions. What 16 bits leave of nothing and of all is made exact again.
Render decodeGrid(Image<float> red, Image<float> green, Image<float> blue) {
    constexpr float rounding = 1e-4F;
    for (float& value : blue) value *= 2;
    for (Image<float>* image : {&red, &green, &blue})
        for (float& value : *image) value = value < rounding ? 0 : value > 1 - rounding ? 1 : value;
    return {std::move(blue), std::move(green), std::move(red), {}, 0};
}

/// Runs the program.
std::string askVersion(const std::filesystem::path& program) {
    const TemporaryFolder folder;
    std::string answer;
    const Command command{program, {"--version"}, folder.path()};
    const Finished finished = runProcess(command, [&answer](std::string_view line) {
        for (const std::string_view start : {"POV-Ray ", "Persistence of Vision(tm) Ray Tracer Version "})
            if (answer.empty() && line.starts_with(start))
                answer = line.substr(start.size(), line.find(' ', start.size()) - start.size());
    });
    if (answer.empty() && (finished.timedOut || finished.signal != 0))
        throw Inconclusive(fmt::format("{} --version {}; run it again", program.string(),
                                       finished.timedOut ? "did not answer within a minute: the machine is too busy"
                                                         : fmt::format("was killed by signal {}", finished.signal)),
                           Failure::Transient);
    if (answer.empty())
        throw Inconclusive(
            fmt::format("{} --version names no POV-Ray; install it with apt-get install povray", program.string()));
    return answer;
}

} // namespace

Channels renderChannels(const std::string& text, glm::ivec2 size, const Options& options, const Progress& progress) {
    const std::filesystem::path found = program(options);
    const TemporaryFolder folder;
    writeScene(folder.path() / sceneName, text);

    Command command{found, {}, folder.path()};
    command.arguments = {fmt::format("+I{}", sceneName),       fmt::format("+O{}", imageName), "+FN16", "File_Gamma=1.0",
                         fmt::format("+W{}", size.x),          fmt::format("+H{}", size.y),    "-D",    "-A",
                         fmt::format("+WT{}", options.threads)};
    command.limit = options.limit;
    command.cpuLimit = std::chrono::ceil<std::chrono::seconds>(options.limit) * options.threads + std::chrono::seconds(1);
    command.fileLimit =
        (std::uintmax_t{64} << 20) + std::uintmax_t{32} * static_cast<unsigned>(size.x) * static_cast<unsigned>(size.y);
    command.memoryLimit = memoryLimit(text.size(), size, options.threads);

    Messages messages(progress);
    const Finished finished = runProcess(command, std::ref(messages));
    requireSuccess(finished, messages, command);
    const std::filesystem::path file = folder.path() / imageName;
    Channels channels{readImage(file, 0, size), readImage(file, 1, size), readImage(file, 2, size), {}};
    channels.blue = takeHitMask(std::move(channels.blue), channels.hit);
    return channels;
}

Render render(const Snapshot& snapshot, glm::ivec2 size, int samples, const Options& options, const Progress& progress) {
    Channels channels = renderChannels(sceneText(snapshot, size, samples, options.recipe), size, options, progress);
    Render image = options.recipe.lights == Recipe::Lights::Points
                       ? decodePoints(channels.red, channels.green, channels.blue, samples)
                       : decodeGrid(std::move(channels.red), std::move(channels.green), std::move(channels.blue));
    image.hit = std::move(channels.hit);
    image.scale = scaleOf(snapshot, options.recipe);
    return image;
}

std::string version(const Options& options) {
    const std::filesystem::path found = program(options);
    std::error_code unknown;
    const auto modified = std::filesystem::last_write_time(found, unknown);

    static std::mutex mutex; // held while the program is asked: who comes meanwhile waits for its answer
    static std::map<std::pair<std::filesystem::path, std::filesystem::file_time_type>, std::string> known;
    const std::scoped_lock lock(mutex);
    std::string& answer = known[{found, modified}];
    if (answer.empty()) answer = askVersion(found);
    return answer;
}

} // namespace shadowbench::groundtruth::povray
