package io.troupe.actor.kotlin

import java.lang.reflect.Constructor
import java.lang.reflect.Member
import java.lang.reflect.Method
import java.lang.reflect.Modifier
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.name
import kotlin.io.path.readText
import kotlin.io.path.walk
import kotlin.io.path.writeText
import org.assertj.core.api.Assertions.assertThat
import org.junit.jupiter.api.Test

/** What compiled users of this module link to is listed in `public-api.txt`: a difference may break them. */
class PublicApiTest {
    /** With `-Dapi=write` the file is rewritten instead of compared. */
    @Test
    fun publicApi_isThatOfTheFile() {
        val text = publicClasses().mapNotNull(::describe).joinToString("\n")
        if (System.getProperty("api") == "write") {
            FILE.writeText(text)
        }
        assertThat(text)
            .`as`("if the difference is intended, renew $FILE by -Dtest=PublicApiTest -Dapi=write")
            .isEqualTo(FILE.readText())
    }

    @Test
    fun internals_areFound() {
        assertThat(internals).contains("OwnerScope", "OwnerDispatcher", "Taker", "Suspending", "awaitPending", "scope")
    }

    private fun publicClasses(): List<Class<*>> {
        val folder = Path.of(FlowBuffer::class.java.protectionDomain.codeSource.location.toURI())
        return folder.walk()
            .map { folder.relativize(it).toString() }
            .filter { it.endsWith(".class") && it != "module-info.class" }
            .map { Class.forName(it.removeSuffix(".class").replace('/', '.').replace('\\', '.')) }
            .filter { isPublic(it) && !it.isSynthetic && it.name.split('$', '.').none(internals::contains) }
            .sortedBy { it.name }
            .toList()
    }

    private fun isPublic(type: Class<*>): Boolean =
        Modifier.isPublic(type.modifiers) &&
            type.enclosingClass?.let(::isPublic) != false &&
            type.enclosingMethod == null

    /** The class with its members; null if it has none: its file holds nothing public. */
    private fun describe(type: Class<*>): String? {
        val members = (type.declaredFields.asList<Member>() + type.declaredConstructors + type.declaredMethods)
            .filter { it.modifiers and (Modifier.PUBLIC or Modifier.PROTECTED) != 0 }
            .filterNot { it is Constructor<*> && it.isSynthetic }
            .filterNot { it.name.contains("lambda$") || it.name.startsWith("access$") || isInternal(it) }
        if (members.isEmpty()) {
            return null
        }
        val lines = members.map { "    " + it.toString().replace("io.troupe.actor.kotlin.", "") }
        val parents = (listOfNotNull(type.superclass) + type.interfaces).joinToString { it.name }
        val head = "${Modifier.toString(type.modifiers)} ${type.name} : $parents".removeSuffix(" : ")
        return (listOf(head) + lines.sorted()).joinToString("\n", postfix = "\n")
    }

    /** The property of a space is public, the function of an owner with the same name is not. */
    private fun isInternal(member: Member): Boolean =
        MANGLED.containsMatchIn(member.name) ||
            member.name.removeSuffix("\$default") in internals && (member as? Method)?.parameterCount != 0

    private companion object {
        val FILE: Path = Path.of("src", "test", "api", "public-api.txt")
        val MANGLED = Regex("""\$\w*actor_kotlin$""")
        val INTERNAL = Regex("""\binternal (?:\w+ )*(?:class|fun|val) (?:<[^>]*> )?(?:[\w<>?]+\.)?(\w+)""")
        val internals: Set<String> =
            Path.of("src", "main", "kotlin").walk()
                .filter { it.name.endsWith(".kt") && Files.isRegularFile(it) }
                .flatMap { INTERNAL.findAll(it.readText()).map { found -> found.groupValues[1] } }
                .toSet()
    }
}
