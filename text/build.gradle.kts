description = "Text input and output: words with positions, nearest names, tables, SVG"

dependencies { api(libs.jspecify) }

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.text") } }
