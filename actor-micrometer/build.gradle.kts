description = "The figures of actor spaces as meters of Micrometer"

dependencies {
    api(project(":actor-core"))
    api(libs.micrometer.core)
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.actor.micrometer") } }
