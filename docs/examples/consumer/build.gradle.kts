// A project outside Troupe. First, in Troupe's root: ./gradlew publishToMavenLocal;
// then: ./gradlew -p docs/examples/consumer run
plugins { application }

repositories {
    mavenLocal()
    mavenCentral()
}

dependencies { implementation("io.troupe:troupe-actor-core:0.1.0-SNAPSHOT") }

// -Pjdk=25 compiles and runs on an installed JDK 25, whatever JDK runs Gradle
providers.gradleProperty("jdk").orNull?.let { jdk -> java.toolchain.languageVersion.set(JavaLanguageVersion.of(jdk)) }

tasks.withType<JavaCompile>().configureEach { options.release.set(21) }

application { mainClass.set("hello.Hello") }
