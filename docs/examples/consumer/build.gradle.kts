// A project outside Troupe. First, in Troupe's root: ./gradlew publishToMavenLocal; then: ./gradlew -p docs/examples/consumer run
plugins { application }

repositories {
    mavenLocal()
    mavenCentral()
}

dependencies { implementation("io.troupe:actor-core:0.1.0-SNAPSHOT") }

tasks.withType<JavaCompile>().configureEach { options.release.set(21) }

application { mainClass.set("hello.Hello") }
