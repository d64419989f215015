package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class EntityParserTest {
    @TempDir
    private Path dir;

    private Worlds worlds;

    @BeforeEach
    void files() {
        worlds = new Worlds(dir);
    }

    private Document parse(String text) {
        return EntityParser.parse(Vocabulary.WORLD, worlds.write("t.world", text), null, Diagnostics.logged());
    }

    @Test
    void entities_nested_keepPropertiesChildrenAndPositions() {
        Entity outer = parse("a 1\nouter ( b \"t\" inner ( c [ 1 2 ] ) d 4 )")
                .entities()
                .getFirst();

        assertThat(outer.type()).isEqualTo("outer");
        assertThat(outer.where()).hasToString(worlds.file("t.world") + ":2:1");
        assertThat(outer.text("b", "")).isEqualTo("t");
        assertThat(outer.number("d", 0)).isEqualTo(4);
        assertThat(outer.children().getFirst().numbers("c")).containsExactly(1, 2);
    }

    @Test
    void brackets_beforeAValueAreAnIndex_otherwiseATuple() {
        Entity root = parse("point[0] [5 6] scale [7] point[1][8 9] last[2]").root();

        assertThat(root.numbers("point[0]")).containsExactly(5, 6);
        assertThat(root.numbers("point[1]")).containsExactly(8, 9);
        assertThat(root.numbers("scale")).containsExactly(7);
        assertThat(root.numbers("last")).containsExactly(2);
    }

    @Test
    void macro_chained_isOverriddenByTheLaterOne() {
        Document document = parse("""
                define first model ( size [ 1 1 ] mass 1 color "red" inner ( a 1 ) )
                define second first ( mass 2 inner ( a 2 ) )
                second ( color "blue" inner ( a 3 ) )
                """);

        Entity instance = document.entities().getFirst();
        assertThat(instance.type()).isEqualTo("model");
        assertThat(instance.numbers("size")).containsExactly(1, 1);
        assertThat(instance.number("mass", 0)).isEqualTo(2);
        assertThat(instance.text("color", "")).isEqualTo("blue");
        assertThat(instance.children())
                .extracting(child -> child.number("a", 0))
                .containsExactly(1.0, 2.0, 3.0);
        assertThat(instance.where().line()).isEqualTo(3);
    }

    @Test
    void include_isRelativeToTheIncludingFile() throws Exception {
        Files.createDirectories(dir.resolve("lib/deep"));
        worlds.write("lib/one.inc", "include \"deep/two.inc\"\none 1");
        worlds.write("lib/deep/two.inc", "include \"../three.inc\" two 2");
        worlds.write("lib/three.inc", "three 3");

        Entity root = parse("include \"lib/one.inc\"").root();

        assertThat(root.properties()).containsOnlyKeys("three", "two", "one");
        assertThat(root.whereOf("three")).hasToString(dir.resolve("lib/three.inc") + ":1:7");
    }

    @Test
    void include_ofOneFileByTwoWays_isNoConflict() {
        worlds.write("common.inc", "define box model ( size [ 1 1 ] ) unit_length \"m\"");
        worlds.write("other.inc", "include \"common.inc\"");

        Document document = parse("include \"common.inc\" include \"other.inc\" box ()");

        assertThat(document.entities()).hasSize(1);
        assertThat(document.root().text("unit_length", "")).isEqualTo("m");
    }

    @Test
    void include_inACircle_namesTheChain() {
        worlds.write("a.inc", "\n  include \"b.inc\"");
        worlds.write("b.inc", "include \"a.inc\"");

        assertThat(worlds.problem("include \"a.inc\""))
                .isEqualTo("b.inc:1:9: a file cannot include itself: t.world -> a.inc -> b.inc -> a.inc");
        assertThat(worlds.problem("include \"./t.world\""))
                .isEqualTo("t.world:1:9: a file cannot include itself: t.world -> t.world");
    }

    @Test
    void file_thatIsMissing_isNamedTogetherWithWhoAskedForIt() {
        assertThat(worlds.problem("# nothing\n include \"gone.inc\""))
                .isEqualTo("t.world:2:10: there is no file gone.inc");
        assertThat(worlds.problemOf(() -> ScenarioReader.readWorld(worlds.file("gone.world"))))
                .isEqualTo("there is no file gone.world");
        assertThat(worlds.problem("include \"..\"")).startsWith("t.world:1:9: ").endsWith(" is not a file");
    }

    @Test
    void file_thatIsNotText_isRefused() throws Exception {
        Files.write(worlds.file("bad.inc"), new byte[] {'#', (byte) 0xe4, '\n'});

        assertThat(worlds.problem("include \"bad.inc\"")).isEqualTo("t.world:1:9: bad.inc is not UTF-8 text");
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "model ( size [1 1]             | t.world:1:19: missing ')': \"model\" opened at t.world:1:7 is never closed",
                "model ( size [1 1 )            | t.world:1:19: missing ']': the tuple of \"size\" opened at t.world:1:14 is not closed before ')'",
                "model ( size [1 color          | t.world:1:17: missing ']': the tuple of \"size\" opened at t.world:1:14 is not closed before 'color'",
                "model ( size [1                | t.world:1:16: missing ']': the tuple of \"size\" opened at t.world:1:14 is not closed before the end of the file",
                "model ( size )                 | t.world:1:14: expected the value of \"size\" (a number, a text in double quotes or a tuple [ .. ]), found ')'",
                "model ( color red )            | t.world:1:15: expected the value of \"color\", found 'red'; texts stand in double quotes",
                "model ( 5 )                    | t.world:1:9: expected a property, an entity or ')', found '5'",
                ")                              | t.world:1:1: expected a property, an entity, include or define, found ')'",
                "model ( include \"a\" )        | t.world:1:9: include belongs at the top level, not inside \"model\"",
                "model ( define a model () )    | t.world:1:9: define belongs at the top level, not inside \"model\"",
                "include pioneer                | t.world:1:9: expected a file name in double quotes after include, found 'pioneer'",
                "define box                     | t.world:1:11: expected an entity type or macro after define box, found the end of the file",
                "define box model size [1 1]    | t.world:1:18: expected '(' after define box model, found 'size'",
                "define position model ()       | t.world:1:8: \"position\" is a built-in entity type",
                "model ( point[0.5] [1 2] )     | t.world:1:15: the index of \"point\" must be a whole number from 0, not 0.5",
                "model ( point[-1] [1 2] )      | t.world:1:15: the index of \"point\" must be a whole number from 0, not -1",
            })
    void text_thatBreaksTheGrammar_isRefusedWhereItStands(String text, String message) {
        assertThat(worlds.problem(text.strip())).isEqualTo(message);
    }

    @Test
    void nesting_withoutEnd_isRefusedBeforeTheStackIsFull() {
        assertThat(worlds.problem("model ( ".repeat(100_000)))
                .isEqualTo("t.world:1:513: entities are nested deeper than 64");
    }

    @Test
    void nesting_byMacros_isRefusedBeforeTheStackIsFull() {
        var text = new StringBuilder("define m0 model ()\n");
        for (int i = 1; i < 20_000; i++) {
            text.append("define m" + i + " model ( m" + (i - 1) + " () )\n");
        }

        assertThat(worlds.problem(text + "m19999 ()")).isEqualTo("t.world:101:21: entities are nested deeper than 100");
    }

    @Test
    void macros_thatGrowExponentially_areRefused() {
        var text = new StringBuilder("define m0 model ()\n");
        for (int i = 1; i < 50; i++) {
            text.append("define m%d model ( m%d() m%d() )\n".formatted(i, i - 1, i - 1));
        }

        assertThat(worlds.problem(text.toString())).isEqualTo("t.world:17:26: more than 100000 entities in one file");
    }

    @Test
    void macros_withManyProperties_areRefused_whereTheirUsesBecomeTooMany() {
        String macro = "define m model (" + properties(10_000) + " )\n";

        assertThat(worlds.problem(macro + "m()\n".repeat(600)))
                .isEqualTo("t.world:502:1: more than 5000000 values in one file; those of a macro count in each use of"
                        + " it");
        assertThat(worlds.problem(macro + derived("m", 200)))
                .isEqualTo("t.world:102:8: the macros up to this one have taken over more than 1000000 properties of"
                        + " other macros");
    }

    /** The maximum number of entities, each with as many properties as Stage's models have. */
    @Test
    void macroWithTwentyProperties_hasAsManyInstancesAsAFileMayHaveEntities() {
        var text = new StringBuilder("define post model (" + properties(20) + " size [0.1 0.1 1] color \"red\" )\n");
        for (int i = 0; i < 60_000; i++) {
            text.append("post ( pose [").append(i).append(" 0 0 0] color \"blue\" )\n");
        }

        Document document = EntityParser.parseText("world", text.toString(), Path.of("t.world"), Diagnostics.logged());

        assertThat(document.root().children()).hasSize(60_000);
        Entity last = document.root().children().getLast();
        assertThat(last.properties()).hasSize(23);
        assertThat(last.properties().keySet()).endsWith("size", "pose", "color");
        assertThat(last.text("color", "")).isEqualTo("blue");
        assertThat(last.numbers("size")).containsExactly(0.1, 0.1, 1);
        assertThat(last.has("color")).isTrue();
        assertThat(last.has("name")).isFalse();
    }

    @Test
    void macros_withManyEntities_areRefused_whereTheyBecomeTooMany() {
        String macros = "define m model (" + " block ()".repeat(10_000) + " ) define n model ( m() )\n";

        assertThat(worlds.problem(macros + derived("n", 200)))
                .isEqualTo("t.world:99:8: the macros up to this one hold more than 1000000 entities or 5000000 values,"
                        + " with those of the macros in them");
    }

    @Test
    void macros_withManyValues_areRefused_whereTheirUsesBecomeTooMany() {
        String macro = "define m model ( block (" + properties(10_000) + " ) )\n";
        String tuple = "define m model ( block ( z [" + " 0".repeat(10_000) + " ] ) )\n";

        for (String text : List.of(macro, tuple)) {
            assertThat(worlds.problem(text + "m()\n".repeat(600)))
                    .isEqualTo("t.world:502:1: more than 5000000 values in one file; those of a macro count in each use"
                            + " of it");
        }
    }

    private static String derived(String base, int count) {
        var text = new StringBuilder();
        for (int i = 0; i < count; i++) {
            text.append("define m").append(i + 1000).append(' ').append(base).append(" ()\n");
        }
        return text.toString();
    }

    private static String properties(int count) {
        var text = new StringBuilder();
        for (int i = 0; i < count; i++) {
            text.append(" point[").append(i).append("] 0");
        }
        return text.toString();
    }

    @Test
    void files_withTooManyWords_areRefused() {
        worlds.write("many.inc", "# \n".repeat(2) + properties(250_000));

        assertThat(worlds.problem("\n" + "( ".repeat(2_100_000)))
                .endsWith("more than 2000000 words, numbers and brackets in one file");
        assertThat(worlds.problem("include \"many.inc\" include \"many.inc\""))
                .endsWith("with this file more than 2000000 words, numbers and brackets have been read");
    }

    @Test
    void includes_thatGrowExponentially_areRefused() {
        worlds.write("f30.inc", "");
        for (int i = 0; i < 30; i++) {
            worlds.write("f" + i + ".inc", "include \"f%d.inc\" include \"f%d.inc\"".formatted(i + 1, i + 1));
        }

        assertThat(worlds.problem("include \"f0.inc\"")).endsWith("more than 1000 files are included");
    }
}
