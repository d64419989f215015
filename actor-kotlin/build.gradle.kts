plugins { alias(libs.plugins.kotlin.jvm) }

description = "Actors with suspend functions, coroutines on an actor space, and flows, for Kotlin"

dependencies {
    api(project(":actor-core"))
    api(libs.kotlin.stdlib)
    api(libs.kotlinx.coroutines)
    compileOnly(project(":actor-service")) // only for users of actors as services
    testImplementation(project(":view"))
    testImplementation(project(":verification"))
    testImplementation(project(path = ":actor-service", configuration = "tests")) // two hosts in one process
}

configurations.testImplementation { extendsFrom(configurations.compileOnly.get()) }

kotlin {
    explicitApi()
    compilerOptions {
        jvmTarget.set(org.jetbrains.kotlin.gradle.dsl.JvmTarget.JVM_21)
        allWarningsAsErrors.set(true)
        javaParameters.set(true)
    }
}

tasks.test {
    inputs.dir("src/main/kotlin") // of PublicApiTest
    inputs.dir("src/test/api")
    inputs.files("src/test/kotlin/io/troupe/actor/kotlin/guide/PurseWiring.kt") // of RecordedTest
    inputs.files("../demo/worlds").withPathSensitivity(PathSensitivity.RELATIVE)
    providers.systemProperty("api").orNull?.let { systemProperty("api", it) }
}

tasks.register<JavaExec>("costs") {
    group = "verification"
    description = "Measures a request and its reply in several ways; --args=\"ROUNDS REQUESTS\"."
    classpath = sourceSets["test"].runtimeClasspath
    mainClass.set("io.troupe.actor.kotlin.CostsKt")
}

tasks.named<Jar>("javadocJar") { from("README.md") } // which says where the KDoc is

// the descriptor of the module names classes of Kotlin
tasks.compileJava {
    val kotlinClasses = tasks.compileKotlin.flatMap { it.destinationDirectory }
    inputs.dir(kotlinClasses).withPathSensitivity(PathSensitivity.RELATIVE)
    options.compilerArgumentProviders.add(CommandLineArgumentProvider {
        listOf("--patch-module", "io.troupe.actor.kotlin=${kotlinClasses.get().asFile}")
    })
}
