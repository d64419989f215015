description = "The code that the paper prints, as programs"

dependencies {
    implementation(project(":actor-core"))
    implementation(project(":playerlike-sim"))
    implementation(project(":services"))
}

// ./gradlew figure17 --args="--seconds 60"
tasks.register<JavaExec>("figure7") {
    group = "application"
    description = "Runs the code of the paper's Figure 7; --args=\"[HOST:PORT] [--seconds N]\"."
    classpath = sourceSets["main"].runtimeClasspath
    mainClass.set("io.troupe.paper.Figure7")
    workingDir = rootDir
}

tasks.register<JavaExec>("figure14") {
    group = "application"
    description = "Runs the code of the paper's Figure 14; --args=\"[HOST:PORT] [--seconds N]\"."
    classpath = sourceSets["main"].runtimeClasspath
    mainClass.set("io.troupe.paper.Demo1")
    workingDir = rootDir
}

tasks.register<JavaExec>("figure17") {
    group = "application"
    description = "Runs the code of the paper's Figure 17; --args=\"[HOST:PORT] [--seconds N]\"."
    classpath = sourceSets["main"].runtimeClasspath
    mainClass.set("io.troupe.paper.Demo2")
    workingDir = rootDir
}

tasks.register<JavaExec>("figure20") {
    group = "application"
    description = "Runs the code of the paper's Figure 20; --args=\"[HOST:PORT] [--seconds N]\"."
    classpath = sourceSets["main"].runtimeClasspath
    mainClass.set("io.troupe.paper.Demo3")
    workingDir = rootDir
}

tasks.test {
    inputs.dir("../../../demo/worlds").withPathSensitivity(PathSensitivity.RELATIVE)
    inputs.dir("src/main/java/io/troupe/paper").withPathSensitivity(PathSensitivity.RELATIVE) // compared with the figures
}

tasks.jar { manifest { attributes("Automatic-Module-Name" to "io.troupe.paper") } }
