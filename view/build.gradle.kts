description = "Log, summary and pictures of a run"

dependencies {
    api(project(":playerlike-sim"))
    api(project(":services"))
    api(project(":common"))
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.view") } }
tasks.test { inputs.files("../demo/worlds", "../docs/figures", "../docs/examples/python").withPathSensitivity(PathSensitivity.RELATIVE) }
