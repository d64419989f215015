package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.File;
import java.io.IOException;
import java.lang.module.ModuleFinder;
import java.net.URISyntaxException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import java.util.jar.Attributes;
import java.util.jar.JarEntry;
import java.util.jar.JarOutputStream;
import java.util.jar.Manifest;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.NullMarked;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.objectweb.asm.ClassWriter;

/** Actor types in named modules, with this library as the automatic module of its jar. */
class NamedModuleTest {
    /**
     * Modules that no module requires, because an automatic module requires none by name; on a command line they are
     * passed to --add-modules.
     */
    private static final Set<String> LIBRARIES = Set.of("org.objectweb.asm");

    private static final String HOME = """
            package %s;
            import io.troupe.actor.Actor;
            import io.troupe.actor.ActorTypeException;
            import io.troupe.actor.promise.Promise;
            import io.troupe.actor.testkit.TestSpace;
            interface Lamp { Promise<String> light(String colour); }
            class Bell extends Actor { public Promise<String> ring() { return Promise.of("ding"); } }
            public final class Home {
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
        var path = List.of(library(), location(ClassWriter.class), location(NullMarked.class));
        home(path, "closed", "");
        home(path, "free", "opens free;");
        home(path, "friend", "opens friend to io.troupe.actor;");
        module(path, "deaf", "opens deaf;", "deaf.Plain", "package deaf; public interface Plain { void go(); }");

        ModuleLayer layer = layer(path, Set.of("closed", "free", "friend", "deaf"));
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

    private static Object live(Class<?> home) throws ReflectiveOperationException {
        return home.getMethod("live").invoke(null);
    }

    private static String refusal(Class<?> home, Class<?> type) throws ReflectiveOperationException {
        return (String) home.getMethod("refusal", Class.class).invoke(null, type);
    }

    private ModuleLayer layer(List<Path> path, Set<String> names) {
        var all = Stream.concat(path.stream(), names.stream().map(folder::resolve))
                .toArray(Path[]::new);
        ModuleLayer boot = ModuleLayer.boot();
        var roots = new HashSet<>(names);
        roots.addAll(LIBRARIES);
        var configuration = boot.configuration().resolve(ModuleFinder.of(all), ModuleFinder.of(), roots);
        var parent = ClassLoader.getPlatformClassLoader();
        return ModuleLayer.defineModulesWithOneLoader(configuration, List.of(boot), parent)
                .layer();
    }

    private void home(List<Path> path, String name, String opening) throws IOException {
        String directives = "requires io.troupe.actor; exports " + name + "; " + opening;
        module(path, name, directives, name + ".Home", HOME.formatted(name));
    }

    private void module(List<Path> path, String name, String directives, String className, String source)
            throws IOException {
        String modulePath = path.stream().map(Path::toString).collect(Collectors.joining(File.pathSeparator));
        new Compiled(folder.resolve(name))
                .add("module-info", "module " + name + " { " + directives + " }")
                .add(className, source)
                .compile("--module-path", modulePath);
    }

    /** The library as it is published: a jar with its module name. A folder of classes is not an automatic module. */
    private Path library() throws Exception {
        Path classes = location(ActorSpace.class);
        if (!Files.isDirectory(classes)) {
            return classes;
        }
        var manifest = new Manifest();
        manifest.getMainAttributes().put(Attributes.Name.MANIFEST_VERSION, "1.0");
        manifest.getMainAttributes().putValue("Automatic-Module-Name", "io.troupe.actor");
        Path jar = folder.resolve("actor-core.jar");
        try (var out = new JarOutputStream(Files.newOutputStream(jar), manifest);
                Stream<Path> files = Files.walk(classes)) {
            var compiled = files.filter(each -> each.toString().endsWith(".class"));
            for (Path file : compiled.toList()) {
                String entry = classes.relativize(file).toString().replace(File.separatorChar, '/');
                out.putNextEntry(new JarEntry(entry));
                Files.copy(file, out);
                out.closeEntry();
            }
        }
        return jar;
    }

    private static Path location(Class<?> type) throws URISyntaxException {
        return Path.of(type.getProtectionDomain().getCodeSource().getLocation().toURI());
    }
}
