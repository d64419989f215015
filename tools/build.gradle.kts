description = "What only programs and tests need: statistics, child JVMs, a progress line, a NATS server as a child process"

dependencies {
    api(project(":common"))
    api(libs.jspecify)
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.tools") } }
