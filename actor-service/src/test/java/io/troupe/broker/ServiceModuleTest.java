package io.troupe.broker;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.api.Assumptions.assumeTrue;

import io.troupe.actor.ActorSpace;
import io.troupe.common.text.SourceScanner;
import java.io.File;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.net.URISyntaxException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.spi.ToolProvider;
import java.util.stream.Collectors;
import java.util.stream.Stream;
import org.jspecify.annotations.NullMarked;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

/** A program on the module path that requires nothing but the module of this library. */
@Timeout(300)
class ServiceModuleTest {
    private static final String DESCRIPTOR = "module ship { requires io.troupe.service; opens ship; }";

    private static final String PROGRAM = """
            package ship;
            import io.troupe.actor.ActorSpace;
            import io.troupe.actor.SpaceSettings;
            import io.troupe.actor.Promise;
            import io.troupe.broker.ActorServices;
            import io.troupe.broker.Broker;
            import io.troupe.broker.BrokerObserver;
            import io.troupe.broker.BrokerSettings;
            import io.troupe.broker.Need;
            import java.time.Duration;
            import java.util.List;
            final class Ship {
                record Guest(String name) {}
                interface Greeter {
                    Promise<String> greet(Guest guest);
                    default String polite(Guest guest) { return "Dear " + guest.name(); }
                }
                public static void main(String[] arguments) throws Exception {
                    var limit = Duration.ofSeconds(60);
                    try (var space = ActorSpace.create(SpaceSettings.named("ship"))) {
                        var broker = Broker.open(space, BrokerSettings.defaults());
                        var services = broker.services();
                        services.publish(space, Greeter.class, "greeter", List.of("greeting"),
                                () -> guest -> Promise.of("Hello, " + guest.name()));
                        try (var connection = services.connect(Greeter.class, Need.ofCapability("guest", "greeting"))) {
                            Guest ada = new Guest("Ada");
                            System.out.println(connection.actor().greet(ada).get(limit));
                            System.out.println(connection.actor().polite(ada));
                        }
                        broker.closeAsync().get(limit);
                    }
                    System.out.println(Ship.class.getModule() + ", " + Broker.class.getModule());
                }
            }
            """;

    @TempDir
    private Path folder;

    @Test
    void program_onTheModulePath_requiresTheLibraryAlone() throws Exception {
        Path descriptor = Files.writeString(folder.resolve("module-info.java"), DESCRIPTOR);
        Path program = Files.writeString(folder.resolve("Ship.java"), PROGRAM);
        Path classes = folder.resolve("classes");
        Class<?> asm = Class.forName("org.objectweb.asm.ClassWriter");
        String libraries = Stream.of(SourceScanner.class, ActorSpace.class, Broker.class, asm, NullMarked.class)
                .map(ServiceModuleTest::location)
                .collect(Collectors.joining(File.pathSeparator));
        compile("-d", classes.toString(), "-p", libraries, descriptor.toString(), program.toString());

        assertThat(java("-p", libraries + File.pathSeparator + classes, "-m", "ship/ship.Ship"))
                .containsExactly("Hello, Ada", "Dear Ada", "module ship, module io.troupe.service");
    }

    private static void compile(String... options) {
        ToolProvider compiler = ToolProvider.findFirst("javac").orElse(null);
        assumeTrue(compiler != null, "a runtime without a compiler");
        var output = new StringWriter();
        var writer = new PrintWriter(output);
        assertThat(compiler.run(writer, writer, options))
                .as("the compiler says: %s", output)
                .isZero();
    }

    /** What a program prints, whose errors are those of the test. */
    private static List<String> java(String... options) throws Exception {
        Path java = Path.of(System.getProperty("java.home"), "bin", "java");
        var child = new ProcessBuilder(Stream.concat(Stream.of(java.toString()), Stream.of(options))
                        .toList())
                .redirectError(ProcessBuilder.Redirect.INHERIT)
                .start();
        try (var lines = child.inputReader()) {
            return lines.lines().toList();
        } finally {
            child.destroy();
            child.waitFor(1, TimeUnit.MINUTES);
        }
    }

    private static String location(Class<?> type) {
        try {
            return Path.of(type.getProtectionDomain()
                            .getCodeSource()
                            .getLocation()
                            .toURI())
                    .toString();
        } catch (URISyntaxException e) {
            throw new IllegalStateException(e);
        }
    }
}
