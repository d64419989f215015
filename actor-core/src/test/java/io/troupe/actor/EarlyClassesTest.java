package io.troupe.actor;

import static org.assertj.core.api.Assertions.assertThat;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.objectweb.asm.ClassReader;
import org.objectweb.asm.ClassVisitor;
import org.objectweb.asm.MethodVisitor;
import org.objectweb.asm.Opcodes;

/** A class that is initialised for the first time when memory is short may be lost for good. */
class EarlyClassesTest {
    /** They begin the rest, or make a space. */
    private static final Set<String> OTHERS = Set.of(
            "io.troupe.actor.ActorSpace",
            "io.troupe.actor.ActorSpace$Global",
            "io.troupe.actor.EarlyClasses",
            "io.troupe.actor.SpaceHome");

    @Test
    void allClassesWithAnInitialiser_areInitialisedWithTheFirstSpace() throws Exception {
        Path classes = Path.of(ActorSpace.class
                .getProtectionDomain()
                .getCodeSource()
                .getLocation()
                .toURI());
        Set<String> found = new TreeSet<>();
        try (Stream<Path> files = Files.walk(classes)) {
            for (Path file :
                    files.filter(each -> each.toString().endsWith(".class")).toList()) {
                if (hasInitialiser(file)) {
                    String path = classes.relativize(file).toString();
                    found.add(path.substring(0, path.length() - ".class".length())
                            .replace(file.getFileSystem().getSeparator(), "."));
                }
            }
        }
        found.removeAll(OTHERS);
        found.removeIf(name -> name.startsWith("io.troupe.actor.testkit."));
        assertThat(found).isNotEmpty();
        List<String> ours = EarlyClasses.NAMES.stream()
                .filter(name -> name.startsWith("io.troupe."))
                .toList();
        assertThat(ours).containsExactlyInAnyOrderElementsOf(found);
    }

    private static boolean hasInitialiser(Path file) throws IOException {
        var found = new boolean[1];
        new ClassReader(Files.readAllBytes(file))
                .accept(
                        new ClassVisitor(Opcodes.ASM9) {
                            @Override
                            public MethodVisitor visitMethod(
                                    int access, String name, String type, String signature, String[] exceptions) {
                                found[0] |= name.equals("<clinit>");
                                return null;
                            }
                        },
                        ClassReader.SKIP_CODE);
        return found[0];
    }

    @Test
    void theirNames_areThoseOfClasses() throws Exception {
        for (String name : EarlyClasses.NAMES) {
            assertThat(Class.forName(name).getName()).isEqualTo(name);
        }
    }
}
