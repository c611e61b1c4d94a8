// The studio over HTTP, for one person at this machine.
//
// Listens on 127.0.0.1 only. Every address begins with a random token; a request whose Host is
// another (a name that someone else points here) or whose Origin is another page is refused. No
// file is read or written for a request. GET: the page, api/state, api/story, api/model.toml,
// api/report.html; POST: api/do, api/capture. JSON: docs/formats.md, "studio".
#pragma once

#include "studio/studio.hpp"

#include <memory>
#include <string>

namespace servoid::studio {

class Server {
  public:
    // port 0: any that is free. Throws UsageError where it is taken.
    Server(Studio& studio, int port);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    std::string url() const; // "http://127.0.0.1:PORT/TOKEN/"
    void start();            // listens, in a thread of its own
    void stop();             // and waits for its end

  private:
    struct Inside; // keeps the HTTP library's headers out of here
    std::unique_ptr<Inside> inside_;
};

} // namespace servoid::studio
