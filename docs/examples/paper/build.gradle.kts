description = "The code that the paper prints, as programs"

dependencies {
    implementation(project(":actor-core"))
    implementation(project(":playerlike-sim"))
    implementation(project(":services"))
}

// ./gradlew figure17 --args="--seconds 60"
for ((figure, main) in mapOf("figure7" to "Figure7", "figure14" to "Demo1", "figure17" to "Demo2", "figure20" to "Demo3")) {
    tasks.register<JavaExec>(figure) {
        group = "application"
        description = "Runs the code of the paper's F${figure.drop(1)}; --args=\"[HOST:PORT] [--seconds N]\"."
        classpath = sourceSets["main"].runtimeClasspath
        mainClass.set("io.troupe.paper.$main")
        workingDir = rootDir
    }
}

tasks.test {
    inputs.dir("../../../demo/worlds").withPathSensitivity(PathSensitivity.RELATIVE)
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.paper") } }
