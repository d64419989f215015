description = "What the other modules share: reading of text, SVG and DOT, statistics, a NATS server as a child process"

dependencies { api(libs.jspecify) }
