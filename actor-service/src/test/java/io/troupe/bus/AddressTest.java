package io.troupe.bus;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatIllegalArgumentException;

import org.junit.jupiter.api.Test;

class AddressTest {
    @Test
    void partWithASlash_orAControlCharacter_isRefused_byItsName() {
        assertThat(new Address("far away. 2", "b")).hasToString("far away. 2/b");
        refused(() -> new Address(" ", "b"), "the node of an address is \" \", expected a name without a slash");
        refused(() -> new Address("a", "b/c"), "the name of an address is \"b/c\", expected a name without a slash");
        var expected = "\", expected a name without control characters";
        refused(() -> new Address("a\n", "b"), "the node of an address is \"a\\u000a" + expected);
        refused(() -> new Address("a", "\0b"), "the name of an address is \"\\u0000b" + expected);
    }

    private static void refused(Runnable making, String message) {
        assertThatIllegalArgumentException().isThrownBy(making::run).withMessage(message);
    }
}
