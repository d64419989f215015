package io.troupe.actor.kotlin

import io.troupe.actor.ActorSpace
import io.troupe.actor.kotlin.guide.PoliteGreeter
import java.io.File
import java.io.PrintWriter
import java.io.StringWriter
import java.lang.module.ModuleDescriptor
import java.util.concurrent.TimeUnit
import java.util.spi.ToolProvider
import kotlinx.coroutines.CoroutineScope
import org.assertj.core.api.Assertions.assertThat
import org.jspecify.annotations.NullMarked
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.Timeout
import org.junit.jupiter.api.io.TempDir

/** A program on the module path that requires nothing but the module of this library. */
@Timeout(300)
class ModuleTest {
    @TempDir private lateinit var folder: File

    @Test
    fun program_onTheModulePath_requiresTheLibraryAlone() {
        val program = folder.resolve("program")
        location(PoliteGreeter::class.java).resolve(GUIDE).copyRecursively(program.resolve(GUIDE))
        val asm = Class.forName("org.objectweb.asm.ClassWriter")
        val used = listOf(ActorSpace::class.java, asm, Unit::class.java, CoroutineScope::class.java)
        val path = (used.map(::location) + library()).joinToString(File.pathSeparator)
        val descriptor = folder.resolve("module-info.java")
        descriptor.writeText("module program { requires io.troupe.actor.kotlin; opens ${GUIDE.replace('/', '.')}; }")
        val toCompile = location(NullMarked::class.java)
        compile("-d", "$program", "-p", path + File.pathSeparator + toCompile, "$descriptor")

        val toRun = path + File.pathSeparator + program
        assertThat(java("--show-module-resolution", "-p", toRun, "-m", "program/$MAIN"))
            .contains("Hello again, Ada")
            .anyMatch { it.startsWith("program requires io.troupe.actor.kotlin ") }
            .noneMatch { it.contains("automatic") || it.contains("io.troupe.service") }
    }

    /** This module in one folder: Gradle compiles the descriptor into another one than Kotlin. */
    private fun library(): File {
        val library = folder.resolve("library")
        location(FlowBuffer::class.java).copyRecursively(library)
        val descriptor =
            javaClass.classLoader.getResources(DESCRIPTOR).asSequence().first {
                it.openStream().use(ModuleDescriptor::read).name() == "io.troupe.actor.kotlin"
            }
        library.resolve(DESCRIPTOR).writeBytes(descriptor.readBytes())
        return library
    }

    private fun compile(vararg options: String) {
        val compiler = ToolProvider.findFirst("javac").orElse(null)
        assumeTrue(compiler != null, "a runtime without a compiler")
        val output = StringWriter()
        val writer = PrintWriter(output)
        assertThat(compiler.run(writer, writer, *options)).`as`("the compiler says: %s", output).isZero()
    }

    /** What a program prints, whose errors are those of the test. */
    private fun java(vararg options: String): List<String> {
        val java = File(System.getProperty("java.home")).resolve("bin/java")
        val child = ProcessBuilder("$java", *options).redirectError(ProcessBuilder.Redirect.INHERIT).start()
        try {
            return child.inputReader().use { it.readLines() }
        } finally {
            child.destroy()
            child.waitFor(1, TimeUnit.MINUTES)
        }
    }

    private fun location(type: Class<*>): File = File(type.protectionDomain.codeSource.location.toURI())

    private companion object {
        const val GUIDE = "io/troupe/actor/kotlin/guide"
        const val MAIN = "io.troupe.actor.kotlin.guide.HelloKt"
        const val DESCRIPTOR = "module-info.class"
    }
}
