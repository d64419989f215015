description = "Actors as services: a bus with typed topics and requests, and a broker that finds, starts and replaces providers"

dependencies {
    api(project(":actor-core"))
    api(project(":common"))
    testImplementation(project(":tools"))
}

// the contract of a bus, which other engines run too
configurations.create("tests") { isCanBeResolved = false }
artifacts {
    add("tests", tasks.register<Jar>("testsJar") {
        archiveClassifier.set("tests")
        from(sourceSets.test.get().output)
    })
}

tasks.test {
    for (name in listOf("soak.minutes", "soak.first")) {
        providers.systemProperty(name).orNull?.let { systemProperty(name, it) }
    }
}
