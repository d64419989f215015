description = "Log, summary and pictures of a run, a live page, and exports to other tools"

dependencies {
    api(project(":playerlike-sim"))
    api(project(":services"))
    api(project(":common"))
    api(project(":drawing"))
    testImplementation(project(":tools"))
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.view") } }
tasks.test { inputs.files("../demo/worlds", "../docs/figures", "../docs/examples/python").withPathSensitivity(PathSensitivity.RELATIVE) }
