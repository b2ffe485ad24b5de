// Debian's Chromium without a window, driven over a pipe by its own protocol (chromedevtools.github.io/devtools-protocol):
// no driver program, no port, no library beside the one for JSON.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace shadowbench::browser {

/// How a page is looked at.
struct Looks {
    int width = 1280, height = 800; // CSS pixels
    bool scripts = true;
    bool dark = false;
    bool still = true; // prefers-reduced-motion
};

class Browser;

/// A tab. Functions throw std::runtime_error with what the browser says, or that it did not answer in time.
class Tab {
public:
    ~Tab();
    Tab(const Tab&) = delete;
    Tab& operator=(const Tab&) = delete;

    /// Loads a file, with what may follow its name ("#pcf"), and waits until it has been loaded.
    void open(const std::filesystem::path& file, const std::string& hash = "");
    /// The same of an address.
    void visit(const std::string& address);

    /// The value of a JavaScript expression; a promise is waited for.
    nlohmann::json value(const std::string& expression);

    /// Waits until the expression is true; throws after ten seconds, naming it.
    void waitFor(const std::string& expression);
    /// Waits until all viewers of cells on the page show theirs, if it has any.
    void waitForViewers() {
        waitFor("[...document.querySelectorAll('.viewer')].every((e) => !e.viewer || e.viewer.shown?.edges)");
    }

    /// A key with its name in KeyboardEvent.key ("n", "ArrowLeft").
    void press(const std::string& key);
    void click(double x, double y);
    void drag(double x, double y, double toX, double toY);

    void resize(int width, int height);

    /// PNG.
    std::string screenshot();

    /// What went wrong since the tab was made: exceptions, messages of console.error and console.warn, files that did not
    /// load, what a content security policy blocked.
    [[nodiscard]] const std::vector<std::string>& complaints() const { return complaints_; }

private:
    friend class Browser;
    Tab(Browser& browser, const Looks& looks);
    nlohmann::json call(const std::string& method, const nlohmann::json& parameters = nlohmann::json::object());
    void mouse(const std::string& type, double x, double y, int buttons);
    void see(const nlohmann::json& event);

    Browser& browser_;
    std::string target_, session_;
    int loads_ = 0;
    std::vector<std::string> complaints_;
};

class Browser {
public:
    /// Starts Chromium, which ends with the object. Throws std::runtime_error naming the package when there is none.
    Browser();
    ~Browser();
    Browser(const Browser&) = delete;
    Browser& operator=(const Browser&) = delete;

    std::unique_ptr<Tab> tab(const Looks& looks = {});

private:
    friend class Tab;
    nlohmann::json call(const std::string& method, const nlohmann::json& parameters, const std::string& session);
    nlohmann::json answerTo(int id, const std::string& method);
    std::optional<nlohmann::json> message(); // nothing if there is none for a while
    void handle(const nlohmann::json& event);

    struct Process;
    std::unique_ptr<Process> process_;
    std::vector<Tab*> tabs_;
    int calls_ = 0;
};

} // namespace shadowbench::browser
