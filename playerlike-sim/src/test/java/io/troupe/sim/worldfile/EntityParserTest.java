package io.troupe.sim.worldfile;

import static java.util.stream.Collectors.joining;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.junit.jupiter.api.Named.named;
import static org.junit.jupiter.params.provider.Arguments.arguments;

import io.troupe.sim.worldfile.Lexer.Token;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.function.IntFunction;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.ValueSource;

class EntityParserTest extends WorldFiles {
    private static final Path FILE = Path.of("t.world");

    private Document parse(String text) {
        return EntityParser.parse(Vocabulary.WORLD, write("t.world", text), null, Diagnostics.logged());
    }

    @Test
    void tokens_ofEveryKind_haveTheirTextAndPosition() {
        List<Token> tokens = Lexer.tokens("size[-1 .5e2]# (\n\tmodel_2( name \"a (b)\" )\r\n", FILE);

        assertThat(tokens)
                .extracting(token -> token.kind() + " " + token.text() + " "
                        + token.where().line() + ":" + token.where().column())
                .containsExactly(
                        "WORD size 1:1",
                        "OPEN_TUPLE [ 1:5",
                        "NUMBER -1 1:6",
                        "NUMBER .5e2 1:9",
                        "CLOSE_TUPLE ] 1:13",
                        "WORD model_2 2:2",
                        "OPEN ( 2:9",
                        "WORD name 2:11",
                        "TEXT a (b) 2:16",
                        "CLOSE ) 2:24",
                        "END  3:1");
    }

    @ParameterizedTest
    @ValueSource(strings = {"0", "-0.5", "+3", "1.", ".25", "1e3", "2.5E-4"})
    void number_inAnyUsualForm_isOneToken(String number) {
        assertThat(Lexer.tokens(number, FILE))
                .extracting(Token::kind)
                .containsExactly(Lexer.Kind.NUMBER, Lexer.Kind.END);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            a 1.2.3 | t.world:1:3: '1.2.3' is not a number
            a 12cm | t.world:1:3: '12cm' is not a number
            a - | t.world:1:3: '-' is not a number
            a 1e999 | t.world:1:3: '1e999' is too large: numbers must be finite
            a "open | t.world:1:3: this text has no closing '"' on its line
            a [1, 2] | t.world:1:5: unexpected ',': values are separated by spaces, nothing else
            a { | t.world:1:3: unexpected character '{'
            a \u00e4 | t.world:1:3: unexpected character U+00E4
            """)
    void text_thatIsNoToken_isRefusedWhereItStands(String text, String message) {
        assertThatThrownBy(() -> Lexer.tokens(text, FILE))
                .isInstanceOf(WorldFileException.class)
                .hasMessage(message);
    }

    @Test
    void entities_nested_keepPropertiesChildrenAndPositions_andIndicesAreNoTuples() {
        Document document = parse("a 1\nouter ( b \"t\" inner ( c [ 1 2 ] ) d 4 )");
        Entity outer = document.entities().getFirst();
        assertThat(outer.type()).isEqualTo("outer");
        assertThat(outer.where()).hasToString(file("t.world") + ":2:1");
        assertThat(outer.text("b", "")).isEqualTo("t");
        assertThat(outer.number("d", 0)).isEqualTo(4);
        assertThat(outer.children().getFirst().numbers("c")).containsExactly(1, 2);
        Entity root = parse("point[0] [5 6] scale [7] point[1][8 9] last[2]").root();
        assertThat(root.numbers("point[0]")).containsExactly(5, 6);
        assertThat(root.numbers("point[1]")).containsExactly(8, 9);
        assertThat(root.numbers("scale")).containsExactly(7);
        assertThat(root.numbers("last")).containsExactly(2);
    }

    @Test
    void macro_chained_isOverriddenByTheLaterOne() {
        Entity instance = parse("""
                define first model ( size [ 1 1 ] mass 1 color "red" inner ( a 1 ) )
                define second first ( mass 2 inner ( a 2 ) )
                second ( color "blue" inner ( a 3 ) )
                """).entities().getFirst();
        assertThat(instance.type()).isEqualTo("model");
        assertThat(instance.numbers("size")).containsExactly(1, 1);
        assertThat(instance.number("mass", 0)).isEqualTo(2);
        assertThat(instance.text("color", "")).isEqualTo("blue");
        assertThat(instance.children())
                .extracting(child -> child.number("a", 0))
                .containsExactly(1.0, 2.0, 3.0);
        assertThat(instance.where().line()).isEqualTo(3);
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            model ( size [1 1] | t.world:1:19: missing ')': "model" opened at t.world:1:7 is never closed
            model ( size [1 1 ) | t.world:1:19: missing ']': the tuple of "size" opened at t.world:1:14 is not closed before ')'
            model ( size [1 color | t.world:1:17: missing ']': the tuple of "size" opened at t.world:1:14 is not closed before 'color'
            model ( size [1 | t.world:1:16: missing ']': the tuple of "size" opened at t.world:1:14 is not closed before the end of the file
            model ( size ) | t.world:1:14: expected the value of "size" (a number, a text in double quotes or a tuple [ .. ]), found ')'
            model ( color red ) | t.world:1:15: expected the value of "color", found 'red'; texts stand in double quotes
            model ( 5 ) | t.world:1:9: expected a property, an entity or ')', found '5'
            ) | t.world:1:1: expected a property, an entity, include or define, found ')'
            model ( include "a" ) | t.world:1:9: include belongs at the top level, not inside "model"
            model ( define a model () ) | t.world:1:9: define belongs at the top level, not inside "model"
            include pioneer | t.world:1:9: expected a file name in double quotes after include, found 'pioneer'
            define box | t.world:1:11: expected an entity type or macro after define box, found the end of the file
            define box model size [1 1] | t.world:1:18: expected '(' after define box model, found 'size'
            model ( point[0.5] [1 2] ) | t.world:1:15: the index of "point" must be a whole number from 0, not 0.5
            model ( point[-1] [1 2] ) | t.world:1:15: the index of "point" must be a whole number from 0, not -1
            """)
    void text_thatBreaksTheGrammar_isRefusedWhereItStands(String text, String message) {
        assertThat(problem(text)).isEqualTo(message);
    }

    @Test
    void include_isRelativeToTheIncludingFile_andMayComeByTwoWays() throws IOException {
        Files.createDirectories(dir.resolve("lib/deep"));
        write("lib/one.inc", "include \"deep/two.inc\"\none 1");
        write("lib/deep/two.inc", "include \"../three.inc\" two 2");
        write("lib/three.inc", "three 3");
        Entity root = parse("include \"lib/one.inc\"").root();
        assertThat(root.properties()).containsOnlyKeys("three", "two", "one");
        assertThat(root.whereOf("three")).hasToString(dir.resolve("lib/three.inc") + ":1:7");
        write("common.inc", "define box model ( size [ 1 1 ] ) unit_length \"m\"");
        write("other.inc", "include \"common.inc\"");
        Document document = parse("include \"common.inc\" include \"other.inc\" box ()");
        assertThat(document.entities()).hasSize(1);
        assertThat(document.root().text("unit_length", "")).isEqualTo("m");
    }

    @Test
    void include_thatCannotBeRead_isRefusedWhereItIsNamed() throws IOException {
        write("a.inc", "\n  include \"b.inc\"");
        write("b.inc", "include \"a.inc\"");
        Files.write(file("bad.inc"), new byte[] {'#', (byte) 0xe4, '\n'});
        assertThat(problem("include \"a.inc\""))
                .isEqualTo("b.inc:1:9: a file cannot include itself: t.world -> a.inc -> b.inc -> a.inc");
        assertThat(problem("include \"./t.world\""))
                .isEqualTo("t.world:1:9: a file cannot include itself: t.world -> t.world");
        assertThat(problem("# nothing\n include \"gone.inc\""))
                .startsWith("t.world:2:10: there is no file gone.inc; looked in ");
        assertThat(problem("include \"bad.inc\"")).isEqualTo("t.world:1:9: bad.inc is not UTF-8 text");
        assertThat(problem("include \"..\"")).startsWith("t.world:1:9: ").endsWith(" is not a file");
        assertThat(problemOf(() -> ScenarioReader.readWorld(file("gone.world"))))
                .isEqualTo("there is no file gone.world");
    }

    @Test
    void text_closedOnTheNextLine_isRefused() {
        assertThatThrownBy(() -> Lexer.tokens("name \"a\nb\"", FILE))
                .hasMessage("t.world:1:6: this text has no closing '\"' on its line");
    }

    // ---- limits

    /** The texts for 0 to count - 1, one after another. */
    private static String each(int count, IntFunction<String> text) {
        return IntStream.range(0, count).mapToObj(text).collect(joining());
    }

    private static String derived(String base, int count) {
        return each(count, i -> "define m" + (i + 1000) + " " + base + " ()\n");
    }

    private static String properties(int count) {
        return each(count, i -> " point[" + i + "] 0");
    }

    static Stream<Arguments> textsThatGrowTooMuch() {
        String base = "define m0 model ()\n";
        String deep = each(19_999, i -> "define m%d model ( m%d () )\n".formatted(i + 1, i));
        String wide = each(49, i -> "define m%d model ( m%d() m%d() )\n".formatted(i + 1, i, i));
        String macro = "define m model (" + properties(10_000) + " )\n";
        String uses = "m()\n".repeat(600);
        String inBlock = "define m model ( block (" + properties(10_000) + " ) )\n";
        String inTuple = "define m model ( block ( z [" + " 0".repeat(10_000) + " ] ) )\n";
        String entities = "define m model (" + " block ()".repeat(10_000) + " ) define n model ( m() )\n";
        String tooManyValues =
                "t.world:502:1: more than 5000000 values in one file; those of a macro count in each use of it";
        return Stream.of(
                arguments(
                        named("nested without end", "model ( ".repeat(100_000)),
                        "t.world:1:513: entities are nested deeper than 64"),
                arguments(
                        named("nested by macros", base + deep + "m19999 ()"),
                        "t.world:101:21: entities are nested deeper than 100"),
                arguments(
                        named("macros that grow exponentially", base + wide),
                        "t.world:17:26: more than 100000 entities in one file"),
                arguments(named("uses of a macro with many properties", macro + uses), tooManyValues),
                arguments(named("uses of a macro with many values in a block", inBlock + uses), tooManyValues),
                arguments(named("uses of a macro with a long tuple", inTuple + uses), tooManyValues),
                arguments(
                        named("macros derived from one with many properties", macro + derived("m", 200)),
                        "t.world:102:8: the macros up to this one have taken over more than 1000000 properties of"
                                + " other macros"),
                arguments(
                        named("macros derived from one with many entities", entities + derived("n", 200)),
                        "t.world:99:8: the macros up to this one hold more than 1000000 entities or 5000000 values,"
                                + " with those of the macros in them"));
    }

    @ParameterizedTest
    @MethodSource("textsThatGrowTooMuch")
    void text_thatGrowsTooMuch_isRefusedWhereItDoes(String text, String message) {
        assertThat(problem(text)).isEqualTo(message);
    }

    /** The maximum number of entities, each with as many properties as Stage's models have. */
    @Test
    void macroWithTwentyProperties_hasAsManyInstancesAsAFileMayHaveEntities() {
        String macro = "define post model (" + properties(20) + " size [0.1 0.1 1] color \"red\" )\n";
        String text = macro + each(60_000, i -> "post ( pose [" + i + " 0 0] color \"blue\" )\n");
        Document document = EntityParser.parseText("world", text, FILE, Diagnostics.logged());
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
    void files_withTooManyWordsOrIncludes_areRefused() {
        write("many.inc", "# \n".repeat(2) + properties(250_000));
        assertThat(problem("\n" + "( ".repeat(2_100_000)))
                .endsWith("more than 2000000 words, numbers and brackets in one file");
        assertThat(problem("include \"many.inc\" include \"many.inc\""))
                .endsWith("with this file more than 2000000 words, numbers and brackets have been read");

        write("f30.inc", "");
        for (int i = 0; i < 30; i++) {
            write("f" + i + ".inc", "include \"f%d.inc\" include \"f%d.inc\"".formatted(i + 1, i + 1));
        }
        assertThat(problem("include \"f0.inc\"")).endsWith("more than 1000 files are included");
    }
}
