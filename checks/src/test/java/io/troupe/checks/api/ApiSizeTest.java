package io.troupe.checks.api;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.checks.Repository;
import io.troupe.checks.api.PublicTypes.PublicType;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

/**
 * The API of actor-core stays small, and is documented. Types that are public only because generated code or another
 * package of the library uses them do not count: they are in {@code io.troupe.actor.internal} and below.
 */
class ApiSizeTest {
    private static final int MOST_TYPES = 40;

    private static List<PublicType> actorCore() throws IOException {
        return PublicTypes.in(Repository.root().resolve("actor-core/src/main/java"));
    }

    @Test
    void publicTypes_ofActorCore_areAtMostForty() throws IOException {
        var api = actorCore().stream()
                .filter(type -> !type.isForTheLibraryOnly())
                .map(PublicType::name)
                .toList();
        assertThat(api)
                .as("API types of actor-core")
                .contains("io.troupe.actor.ActorSpace", "io.troupe.actor.promise.Promise")
                .hasSizeLessThanOrEqualTo(MOST_TYPES);
    }

    @Test
    void publicTypes_ofActorCore_haveJavadoc() throws IOException {
        assertThat(actorCore())
                .filteredOn(type -> type.javadoc().isEmpty())
                .as("public types without a class comment")
                .isEmpty();
    }

    @Test
    void reader_seesPublicTypesOnly_andWhichAreInternal(@TempDir Path folder) throws IOException {
        Files.writeString(folder.resolve("Marked.java"), """
                package some.internal;
                /** Helps
                 * the library. */
                @Deprecated
                public class Marked { public static class Inner {} }
                class Hidden {}
                """);
        Files.writeString(folder.resolve("Bare.java"), """
                package some;
                // for generated code
                public record Bare(int size) {}
                """);
        assertThat(PublicTypes.in(folder))
                .containsExactly(
                        new PublicType("some.Bare", ""), new PublicType("some.internal.Marked", "Helps the library."));
        assertThat(PublicTypes.in(folder))
                .extracting(PublicType::isForTheLibraryOnly)
                .containsExactly(false, true);
    }
}
