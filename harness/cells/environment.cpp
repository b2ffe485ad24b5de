#include "harness/cells/environment.h"

#include "base/hash.h"

#include "embedded_commit.h"

#include <ctime>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <map>
#include <string_view>
#include <unistd.h>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

/// "family" of "cpu family	: 6"; nothing for a line without a colon.
std::pair<std::string, std::string> keyAndValue(const std::string& line) {
    const std::size_t colon = line.find(": ");
    if (colon == std::string::npos) return {};
    return {line.substr(0, line.find_last_not_of(" \t", colon - 1) + 1), line.substr(colon + 2)};
}

/// What the kernel says of the first processor.
std::map<std::string, std::string> firstProcessor() {
    std::map<std::string, std::string> known;
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line) && !line.empty();) known.insert(keyAndValue(line));
    return known;
}

std::string valueOf(const std::map<std::string, std::string>& known, const std::string& key) {
    const auto found = known.find(key);
    return found == known.end() ? "unknown" : found->second;
}

/// "family 6, model 85, stepping 7, features 1f0c…".
std::string featuresOf(const std::map<std::string, std::string>& cpu) {
    return fmt::format("family {}, model {}, stepping {}, features {}", valueOf(cpu, "cpu family"), valueOf(cpu, "model"),
                       valueOf(cpu, "stepping"), hash128(valueOf(cpu, "flags")).text());
}

/// Installed packages with their versions, as Debian's package manager lists them; empty elsewhere.
std::map<std::string, std::string> installedPackages() {
    std::map<std::string, std::string> versions;
    std::ifstream status("/var/lib/dpkg/status");
    std::string package;
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("Package: ")) package = line.substr(9);
        if (line.starts_with("Version: ")) versions[package] = line.substr(9);
    }
    return versions;
}

/// "libosmesa6 22.3.6-1, libllvm15 …": those that are installed.
std::string revisionsOf(const std::map<std::string, std::string>& installed, const std::vector<std::string>& packages) {
    std::vector<std::string> found;
    for (const std::string& package : packages)
        if (const auto version = installed.find(package); version != installed.end())
            found.push_back(package + " " + version->second);
    return fmt::format("{}", fmt::join(found, ", "));
}

/// "glibc 2.36".
std::string libraryVersion() {
    std::string text(64, '\0');
    const std::size_t length = confstr(_CS_GNU_LIBC_VERSION, text.data(), text.size());
    if (length == 0) return "unknown C library";
    text.resize(length - 1); // without the zero that confstr counts
    return text;
}

const std::map<std::string, std::string>& packages() {
    static const std::map<std::string, std::string> installed = installedPackages();
    return installed;
}

/// The packages of a rasteriser of Mesa's in software, and of the compiler that its name tells: "llvmpipe (LLVM 15.0.6, …".
std::string mesaOf(const gl::ContextInfo& context) {
    if (!context.software) return "";
    std::vector<std::string> names{"libosmesa6"};
    if (context.platform == gl::Platform::Egl) names = {"libegl-mesa0", "libgl1-mesa-dri"};
    constexpr std::string_view compiler = "(LLVM ";
    if (const std::size_t at = context.renderer.find(compiler); at != std::string::npos) {
        const std::string version = context.renderer.substr(at + compiler.size());
        names.push_back("libllvm" + version.substr(0, version.find('.')));
    }
    return revisionsOf(packages(), names);
}

/// The parts that are the same as long as the program runs.
Environment ofThisMachine() {
    const std::map<std::string, std::string> cpu = firstProcessor();
    Environment environment;
    environment.cpu = valueOf(cpu, "model name");
    environment.cpuFeatures = featuresOf(cpu);
    environment.compiler = std::string("g++ ") + __VERSION__;
    environment.libraries = fmt::format("{}, {}", libraryVersion(), revisionsOf(packages(), {"libstdc++6"}));
    return environment;
}

} // namespace

Environment environmentOf(const gl::ContextInfo& context) {
    static const Environment machine = ofThisMachine();
    Environment environment = machine;
    environment.renderer = context.renderer;
    environment.gl = context.version;
    environment.platform = gl::name(context.platform);
    environment.vendor = context.vendor;
    environment.driver = context.driver;
    environment.mesa = mesaOf(context);
    environment.rasterThreads = context.rasterThreads;
    environment.vectorBits = context.vectorBits;
    return environment;
}

Commit builtFrom() { return {embedded::commit, embedded::dirty}; }

std::string programHash() { return embedded::program; }
std::string metricCodeHash() { return embedded::metric_code; }

std::string programVersion() {
    return fmt::format("{} (commit {}{})", embedded::version, std::string_view(embedded::commit).substr(0, 12),
                       embedded::dirty ? ", with changes" : "");
}

std::string timeNow() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

} // namespace shadowbench
