#pragma once
// What is had of the breeding room as files.

#include "base/executor.h"
#include "studio/breeding_store.h"
#include "studio/web_server.h"

namespace espalier::studio {

struct BreedingAnswer {
  HttpResponse response;
  bool changed = false;  // the project has other sessions now
};

/// `rest`: of the path, after "/projects/ID/breeding/". Models are made by the executor. Throws Error.
BreedingAnswer answer_breeding(Store& store, std::int64_t project, const HttpRequest& request, const std::string& rest,
                               Executor& executor);

}  // namespace espalier::studio
