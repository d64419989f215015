// A Kotlin project outside Troupe. First, in Troupe's root: ./gradlew publishToMavenLocal
// then: ./gradlew -p docs/examples/consumer-kotlin run
plugins {
    kotlin("jvm") version "2.4.21"
    application
}

repositories {
    mavenLocal()
    mavenCentral()
}

dependencies { implementation("io.troupe:troupe-actor-kotlin:0.1.0-SNAPSHOT") }

// -Pjdk=25 compiles and runs on an installed JDK 25, whatever JDK runs Gradle
providers.gradleProperty("jdk").orNull?.let { jdk -> java.toolchain.languageVersion.set(JavaLanguageVersion.of(jdk)) }

kotlin { compilerOptions { jvmTarget.set(org.jetbrains.kotlin.gradle.dsl.JvmTarget.JVM_21) } }

tasks.withType<JavaCompile>().configureEach { options.release.set(21) }

application { mainClass.set("hello.HelloKt") }
