#pragma once
// Tables of the breeding room in the file of projects, and what the store does to them with a whole project.

#include <cstdint>
#include <string>
#include <vector>

#include "studio/database.h"

namespace espalier::studio {

/// Makes them: version 4 of the file.
extern const char* const kBreedingTables;

/// All sessions of a project once more, for its copy. Within a transaction.
void copy_breedings(Database& database, std::int64_t project, std::int64_t copy);
/// Lists of files, as JSON, of the states that generations of the project were bred in: their bytes are not to be
/// forgotten.
std::vector<std::string> breeding_file_lists(Database& database, std::int64_t project);

}  // namespace espalier::studio
