description = "Actors as services: bus and broker"

dependencies {
    api(project(":actor-core"))
    api(project(":common"))
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.service") } }

tasks.test {
    for (name in listOf("soak.minutes", "soak.first")) {
        providers.systemProperty(name).orNull?.let { systemProperty(name, it) }
    }
}
