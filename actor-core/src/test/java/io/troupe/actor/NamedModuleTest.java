package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import java.io.File;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.lang.module.ModuleFinder;
import java.net.URISyntaxException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.spi.ToolProvider;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.NullMarked;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.condition.EnabledIfSystemProperty;
import org.junit.jupiter.api.io.TempDir;
import org.objectweb.asm.ClassWriter;

/** Actor types in named modules, with this library as a module. */
@Timeout(300)
class NamedModuleTest {
    private static final String HOME = """
            package %s;
            import io.troupe.actor.Actor;
            import io.troupe.actor.ActorTypeException;
            import io.troupe.actor.Promise;
            import io.troupe.actor.testkit.TestSpace;
            interface Lamp { Promise<String> light(String colour); }
            class Bell extends Actor { public Promise<String> ring() { return Promise.of("ding"); } }
            public final class Home {
                public static void main(String[] arguments) {
                    System.out.println(ModuleLayer.boot().modules().size() < 12 ? "few modules" : "many modules");
                    System.out.println(Home.class.getModule().isNamed() + ", " + Actor.class.getModule().isNamed());
                    System.out.println(live());
                }
                public static String live() {
                    try (var test = new TestSpace()) {
                        Lamp lamp = test.spawn(Lamp.class, () -> colour -> Promise.of(colour + " light"));
                        Bell bell = test.spawn(Bell.class, Bell::new);
                        return test.get(lamp.light("red")) + ", " + test.get(bell.ring());
                    }
                }
                public static String refusal(Class<?> type) {
                    try (var test = new TestSpace()) {
                        return "not refused: " + test.spawn(type, () -> null);
                    } catch (ActorTypeException e) {
                        return e.getMessage();
                    }
                }
                public static Class<?> lamp() { return Lamp.class; }
            }
            """;

    @TempDir
    private Path folder;

    @Test
    void namedModule_hasToOpenThePackageOfItsActorTypes() throws Exception {
        home("closed", "");
        home("free", "opens free;");
        home("friend", "opens friend to io.troupe.actor;");
        module("deaf", "opens deaf;", "deaf.Plain", "package deaf; public interface Plain { void go(); }");

        ModuleLayer layer = layer(Set.of("closed", "free", "friend", "deaf"));
        Class<?> closed = layer.findLoader("closed").loadClass("closed.Home");
        Class<?> free = layer.findLoader("free").loadClass("free.Home");
        Class<?> friend = layer.findLoader("friend").loadClass("friend.Home");
        Class<?> plain = layer.findLoader("deaf").loadClass("deaf.Plain");
        assertThat(free.getModule().getName()).isEqualTo("free");
        assertThat(live(free)).isEqualTo("red light, ding");
        assertThat(live(friend)).isEqualTo("red light, ding");
        assertThat(refusal(closed, (Class<?>) closed.getMethod("lamp").invoke(null)))
                .startsWith("closed.Lamp cannot be an actor type")
                .contains("write \"opens closed;\" in the module-info of closed");
        assertThat(refusal(free, plain))
                .startsWith("deaf.Plain cannot be an actor type")
                .contains("module deaf does not read module io.troupe.actor")
                .contains("\"requires io.troupe.actor;\"");
    }

    /** The JVM of a test has all modules of the JDK; this one has those that are required. */
    @Test
    void program_onTheModulePath_requiresTheLibraryAlone() throws Exception {
        home("free", "opens free;");

        assertThat(java(running(), "-p", path(library(), asm(), folder), "-m", "free/free.Home"))
                .contains("true, true", "red light, ding");
    }

    @Test
    void program_onTheClassPathOfTheModule_canHaveActorTypes() throws Exception {
        home("free", "opens free;");

        var options = List.of("-p", path(library(), asm()), "--add-modules", "io.troupe.actor");
        var command = new ArrayList<>(options);
        command.addAll(List.of("-cp", folder.resolve("free").toString(), "free.Home"));
        assertThat(java(running(), command.toArray(String[]::new))).contains("false, true", "red light, ding");
    }

    /** Seconds for the linker. */
    @Test
    @EnabledIfSystemProperty(named = "thorough", matches = ".*")
    void program_thatIsLinked_runs() throws Exception {
        home("free", "opens free;");
        ToolProvider linker = ToolProvider.findFirst("jlink").orElse(null);
        assumeTrue(linker != null, "a runtime without a linker");

        Path image = folder.resolve("image");
        var output = new StringWriter();
        var writer = new PrintWriter(output);
        int status = linker.run(
                writer,
                writer,
                "--module-path",
                path(library(), asm(), folder),
                "--add-modules",
                "free",
                "--output",
                image.toString());
        assertThat(status).as("jlink says: %s", output).isZero();
        assertThat(java(image, "-m", "free/free.Home")).containsExactly("few modules", "true, true", "red light, ding");
    }

    private static Object live(Class<?> home) throws ReflectiveOperationException {
        return home.getMethod("live").invoke(null);
    }

    private static String refusal(Class<?> home, Class<?> type) throws ReflectiveOperationException {
        return (String) home.getMethod("refusal", Class.class).invoke(null, type);
    }

    private ModuleLayer layer(Set<String> names) throws URISyntaxException {
        ModuleLayer boot = ModuleLayer.boot();
        var finder = ModuleFinder.of(library(), asm(), folder);
        var configuration = boot.configuration().resolve(finder, ModuleFinder.of(), names);
        var parent = ClassLoader.getPlatformClassLoader();
        return ModuleLayer.defineModulesWithOneLoader(configuration, List.of(boot), parent)
                .layer();
    }

    private void home(String name, String opening) throws Exception {
        String directives = "requires io.troupe.actor; exports " + name + "; " + opening;
        module(name, directives, name + ".Home", HOME.formatted(name));
    }

    private void module(String name, String directives, String className, String source) throws Exception {
        new Compiled(folder.resolve(name))
                .add("module-info", "module " + name + " { " + directives + " }")
                .add(className, source)
                .compile("--module-path", path(library(), asm(), location(NullMarked.class)));
    }

    private static List<String> java(Path home, String... options) throws IOException, InterruptedException {
        return ChildJvm.run(ProcessBuilder.Redirect.INHERIT, home, List.of(options))
                .lines();
    }

    private static Path running() {
        return Path.of(System.getProperty("java.home"));
    }

    private static String path(Path... places) {
        return Stream.of(places).map(Path::toString).collect(Collectors.joining(File.pathSeparator));
    }

    private static Path library() throws URISyntaxException {
        return location(ActorSpace.class);
    }

    private static Path asm() throws URISyntaxException {
        return location(ClassWriter.class);
    }

    private static Path location(Class<?> type) throws URISyntaxException {
        return Path.of(type.getProtectionDomain().getCodeSource().getLocation().toURI());
    }
}
