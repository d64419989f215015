package io.troupe.sim.worldfile;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.sim.worldfile.Lexer.Token;
import java.nio.file.Path;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

class LexerTest {
    private static final Path FILE = Path.of("t.world");

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
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '`',
            value = {
                "a 1.2.3      | t.world:1:3: '1.2.3' is not a number",
                "a 12cm       | t.world:1:3: '12cm' is not a number",
                "a -          | t.world:1:3: '-' is not a number",
                "a 1e999      | t.world:1:3: '1e999' is too large: numbers must be finite",
                "a \"open     | t.world:1:3: this text has no closing '\"' on its line",
                "a [1, 2]     | t.world:1:5: unexpected ',': values are separated by spaces, nothing else",
                "a {          | t.world:1:3: unexpected character '{'",
                "a \u00e4     | t.world:1:3: unexpected character U+00E4",
            })
    void text_thatIsNoToken_isRefusedWhereItStands(String text, String message) {
        assertThatThrownBy(() -> Lexer.tokens(text.strip(), FILE))
                .isInstanceOf(WorldFileException.class)
                .hasMessage(message);
    }

    @Test
    void text_closedOnTheNextLine_isRefused() {
        assertThatThrownBy(() -> Lexer.tokens("name \"a\nb\"", FILE))
                .hasMessage("t.world:1:6: this text has no closing '\"' on its line");
    }
}
