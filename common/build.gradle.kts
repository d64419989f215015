description = "Parsing, names, drawing and statistics for the other modules"

dependencies { api(libs.jspecify) }

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.common") } }
