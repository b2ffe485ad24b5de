#include "tests/browser/browser.h"

#include "base/process.h"
#include "base/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <map>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace shadowbench::browser {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience{20};
constexpr int commandsIn = 3, answersOut = 4; // where --remote-debugging-pipe has them

std::string chromium() {
    if (const auto found = findProgram("chromium")) return found->string();
    throw std::runtime_error("the tests of the pages need Chromium; install it with apt-get install chromium");
}

std::vector<std::string> arguments(const std::string& program, const std::string& profile) {
    // As root, Chromium starts only without its sandbox; the pages are our own.
    return {program,
            "--headless=new",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-extensions",
            "--hide-scrollbars",
            "--force-color-profile=srgb",
            "--remote-debugging-pipe",
            "--user-data-dir=" + profile,
            "about:blank"};
}

/// In the child, between fork and exec.
[[noreturn]] void become(std::vector<char*>& words, int commands, int answers) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::setpgid(0, 0);
    // Out of the way first: either may be one of the numbers that they are to have.
    const int in = ::fcntl(commands, F_DUPFD, 10), out = ::fcntl(answers, F_DUPFD, 10);
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) ::dup2(nothing, stream);
    ::dup2(in, commandsIn);
    ::dup2(out, answersOut);
    ::execv(words[0], words.data());
    ::_exit(127);
}

std::string textOf(const Json& call) {
    std::string text = call.value("type", "") + ":";
    for (const Json& argument : call["args"])
        text += " " + (argument.contains("value") ? argument["value"].dump() : argument.value("description", "?"));
    return text;
}

std::string fromBase64(const std::string& text) {
    std::array<int, 256> values{};
    values.fill(-1);
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < letters.size(); ++i) values[static_cast<unsigned char>(letters[i])] = static_cast<int>(i);
    std::string bytes;
    unsigned bits = 0;
    int count = 0;
    for (const char letter : text) {
        const int value = values[static_cast<unsigned char>(letter)];
        if (value < 0) break;
        bits = bits << 6U | static_cast<unsigned>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
    }
    return bytes;
}

} // namespace

struct Browser::Process {
    Process() {
        std::array<int, 2> in{}, out{};
        if (::pipe2(in.data(), O_CLOEXEC) != 0 || ::pipe2(out.data(), O_CLOEXEC) != 0)
            throw std::runtime_error("no pipe to Chromium could be made");
        std::vector<std::string> words = arguments(chromium(), (folder.path() / "profile").string());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        child = ::fork();
        if (child == 0) become(pointers, in[0], out[1]);
        ::close(in[0]);
        ::close(out[1]);
        commands = in[1];
        answers = out[0];
    }

    ~Process() {
        ::close(commands);
        ::close(answers);
        ::kill(-child, SIGKILL);
        ::waitpid(child, nullptr, 0);
    }

    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    void send(const std::string& text) const {
        const char* next = text.c_str();
        std::size_t left = text.size() + 1; // with the 0 that ends a message
        while (left > 0) {
            const ssize_t written = ::write(commands, next, left);
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) throw std::runtime_error("Chromium has ended");
            next += written;
            left -= static_cast<std::size_t>(written);
        }
    }

    TemporaryFolder folder;
    pid_t child = -1;
    int commands = -1, answers = -1;
    std::string received;
};

Browser::Browser() {
    std::signal(SIGPIPE, SIG_IGN); // a write to a Chromium that has ended is an error to report
    process_ = std::make_unique<Process>();
}

Browser::~Browser() = default;

std::unique_ptr<Tab> Browser::tab(const Looks& looks) { return std::unique_ptr<Tab>(new Tab(*this, looks)); }

std::optional<Json> Browser::message() {
    for (;;) {
        const std::size_t end = process_->received.find('\0');
        if (end != std::string::npos) {
            const Json parsed = Json::parse(process_->received.substr(0, end));
            process_->received.erase(0, end + 1);
            return parsed;
        }
        pollfd waiting{process_->answers, POLLIN, 0};
        if (::poll(&waiting, 1, 100) <= 0) return std::nullopt;
        std::array<char, 65536> buffer{};
        const ssize_t count = ::read(process_->answers, buffer.data(), buffer.size());
        if (count <= 0) throw std::runtime_error("Chromium has ended");
        process_->received.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

void Browser::handle(const Json& event) {
    const auto tab = std::ranges::find(tabs_, event.value("sessionId", ""), &Tab::session_);
    if (tab != tabs_.end()) (*tab)->see(event);
}

Json Browser::call(const std::string& method, const Json& parameters, const std::string& session) {
    Json command{{"id", ++calls_}, {"method", method}, {"params", parameters}};
    if (!session.empty()) command["sessionId"] = session;
    process_->send(command.dump());
    return answerTo(calls_, method);
}

Json Browser::answerTo(int id, const std::string& method) {
    for (const auto start = Clock::now(); Clock::now() - start < patience;) {
        const std::optional<Json> answer = message();
        if (!answer) continue;
        if (!answer->contains("id")) {
            handle(*answer);
            continue;
        }
        if ((*answer)["id"] != id) continue;
        if (answer->contains("error")) throw std::runtime_error(fmt::format("{}: {}", method, (*answer)["error"].dump()));
        return (*answer)["result"];
    }
    throw std::runtime_error(fmt::format("Chromium has not answered {} in {} s", method, patience.count()));
}

Tab::Tab(Browser& browser, const Looks& looks) : browser_(browser) {
    target_ = browser_.call("Target.createTarget", {{"url", "about:blank"}}, "")["targetId"];
    session_ = browser_.call("Target.attachToTarget", {{"targetId", target_}, {"flatten", true}}, "")["sessionId"];
    browser_.tabs_.push_back(this);
    for (const char* domain : {"Page", "Runtime", "Log"}) call(std::string(domain) + ".enable");
    resize(looks.width, looks.height);
    call("Emulation.setScriptExecutionDisabled", {{"value", !looks.scripts}});
    const Json colours{{"name", "prefers-color-scheme"}, {"value", looks.dark ? "dark" : "light"}};
    const Json motion{{"name", "prefers-reduced-motion"}, {"value", looks.still ? "reduce" : "no-preference"}};
    call("Emulation.setEmulatedMedia", {{"features", Json::array({colours, motion})}});
}

Tab::~Tab() {
    std::erase(browser_.tabs_, this);
    try {
        browser_.call("Target.closeTarget", {{"targetId", target_}}, "");
    } catch (const std::exception&) { // it ends with the browser
    }
}

Json Tab::call(const std::string& method, const Json& parameters) { return browser_.call(method, parameters, session_); }

void Tab::see(const Json& event) {
    const std::string method = event.value("method", "");
    const Json& what = event["params"];
    if (method == "Page.loadEventFired") ++loads_;
    if (method == "Runtime.exceptionThrown") {
        const Json& details = what["exceptionDetails"];
        complaints_.push_back(details.value("text", "") + " " +
                              (details.contains("exception") ? details["exception"].value("description", "") : ""));
    }
    if (method == "Runtime.consoleAPICalled" && (what["type"] == "error" || what["type"] == "warning"))
        complaints_.push_back(textOf(what));
    if (method == "Log.entryAdded" && what["entry"]["level"] == "error")
        complaints_.push_back(what["entry"].value("text", "") + " " + what["entry"].value("url", ""));
}

void Tab::open(const std::filesystem::path& file, const std::string& hash) {
    call("Page.navigate", {{"url", "about:blank"}}); // or a file with another hash would not be loaded again
    waitFor("document.readyState === 'complete' && location.href === 'about:blank'");
    std::string address = "file://";
    for (const char letter : std::filesystem::absolute(file).string())
        address += std::string_view("%?#").find(letter) == std::string_view::npos
                       ? std::string(1, letter)
                       : fmt::format("%{:02X}", static_cast<unsigned char>(letter));
    visit(address + hash);
}

void Tab::visit(const std::string& address) {
    const int before = loads_;
    const Json answer = call("Page.navigate", {{"url", address}});
    if (answer.contains("errorText")) throw std::runtime_error(address + ": " + answer["errorText"].get<std::string>());
    for (const auto start = Clock::now(); loads_ == before;) {
        if (Clock::now() - start > patience) throw std::runtime_error(address + " was not loaded in time");
        if (const auto event = browser_.message()) browser_.handle(*event);
    }
}

Json Tab::value(const std::string& expression) {
    const Json answer =
        call("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
    if (answer.contains("exceptionDetails"))
        throw std::runtime_error(expression + ": " + answer["exceptionDetails"].dump().substr(0, 400));
    return answer["result"].contains("value") ? answer["result"]["value"] : Json();
}

void Tab::waitFor(const std::string& expression) {
    for (const auto start = Clock::now(); Clock::now() - start < std::chrono::seconds(10);) {
        if (value("Boolean(" + expression + ")") == true) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    throw std::runtime_error("this did not become true: " + expression);
}

void Tab::press(const std::string& key) {
    // What the browser itself does with a key, such as leading the focus on, goes by its code.
    static const std::map<std::string, int> codes{{"Tab", 9}, {"Enter", 13}, {"Escape", 27}, {" ", 32}, {"ArrowRight", 39}};
    Json event{{"type", "keyDown"}, {"key", key}};
    if (key.size() == 1) event["text"] = key;
    if (key == "Enter") event["text"] = "\r";
    if (const auto code = codes.find(key); code != codes.end()) event["windowsVirtualKeyCode"] = code->second;
    call("Input.dispatchKeyEvent", event);
    event["type"] = "keyUp";
    event.erase("text");
    call("Input.dispatchKeyEvent", event);
}

void Tab::mouse(const std::string& type, double x, double y, int buttons) {
    call("Input.dispatchMouseEvent", {{"type", type},
                                      {"x", x},
                                      {"y", y},
                                      {"button", type == "mouseMoved" && buttons == 0 ? "none" : "left"},
                                      {"buttons", buttons},
                                      {"clickCount", 1}});
}

void Tab::click(double x, double y) { drag(x, y, x, y); }

void Tab::drag(double x, double y, double toX, double toY) {
    mouse("mouseMoved", x, y, 0);
    mouse("mousePressed", x, y, 1);
    if (x != toX || y != toY) {
        mouse("mouseMoved", (x + toX) / 2, (y + toY) / 2, 1);
        mouse("mouseMoved", toX, toY, 1);
    }
    mouse("mouseReleased", toX, toY, 0);
}

void Tab::resize(int width, int height) {
    call("Emulation.setDeviceMetricsOverride",
         {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

std::string Tab::screenshot() { return fromBase64(call("Page.captureScreenshot", {{"format", "png"}})["data"]); }

} // namespace shadowbench::browser
