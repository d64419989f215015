description = "What the other modules share: reading of text, suggestions, colours by name, installed programs"

dependencies { api(libs.jspecify) }
