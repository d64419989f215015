description = "Pictures as text: SVG and DOT"

dependencies { api(libs.jspecify) }
