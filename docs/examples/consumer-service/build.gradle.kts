// Actors as services, in a project outside Troupe. First, in Troupe's root: ./gradlew publishToMavenLocal
// then: ./gradlew -p docs/examples/consumer-service run; --args=nats://HOST:4222 names a NATS server
plugins { application }

repositories {
    mavenLocal()
    mavenCentral()
}

dependencies {
    implementation("io.troupe:troupe-actor-service:0.1.0-SNAPSHOT")
    implementation("io.troupe:troupe-actor-nats:0.1.0-SNAPSHOT") // only for services over hosts
}

// -Pjdk=25 compiles and runs on an installed JDK 25, whatever JDK runs Gradle
providers.gradleProperty("jdk").orNull?.let { jdk -> java.toolchain.languageVersion.set(JavaLanguageVersion.of(jdk)) }

tasks.withType<JavaCompile>().configureEach { options.release.set(21) }

application {
    mainModule.set("hello")
    mainClass.set("hello.HelloService")
}
