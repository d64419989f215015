package io.troupe.demo.hosts;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

import io.troupe.bus.nats.NatsSettings;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.ParameterException;

/** What the options of the bus yield, and what they refuse before anything is opened. */
class BusOptionsTest {
    @TempDir
    private Path folder;

    @Command(name = "use")
    static final class Use {
        @Mixin
        private BusOptions bus;
    }

    private BusOptions parse(String line) {
        var use = new Use();
        new CommandLine(use)
                .parseArgs(line.replace("DIR", folder.toString()).trim().split(" +"));
        return use.bus;
    }

    private NatsSettings settings(String line) {
        return parse(line).settings(Map.of("TROUPE_BUS_PASSWORD", "of the environment"));
    }

    @Test
    void address_isEnough() {
        NatsSettings settings = settings("--bus nats://base:4222");
        assertThat(settings).hasToString(NatsSettings.at("nats://base:4222").toString());
        assertThat(parse("--bus nats://base").node())
                .endsWith("-" + ProcessHandle.current().pid());
    }

    @Test
    void serversApplicationAndName() {
        String line = "--bus nats://a:4222,nats://b:4222 --application warehouse --name robot1";
        assertThat(settings(line).servers()).isEqualTo(List.of("nats://a:4222", "nats://b:4222"));
        assertThat(settings(line).application()).isEqualTo("warehouse");
        assertThat(parse(line).node()).isEqualTo("robot1");
        assertThat(parse(line).isGiven()).isTrue();
        assertThat(parse("--name x").isGiven()).isFalse();
    }

    @Test
    void password_comesFromTheFile_elseFromTheEnvironment_neverFromTheCommandLine() throws IOException {
        Files.writeString(folder.resolve("password"), "of the file\nsecond line\n");
        assertThat(settings("--bus nats://base --bus-user ada --bus-password-file DIR/password")
                        .password())
                .isEqualTo("of the file");
        NatsSettings settings = settings("--bus nats://base --bus-user ada");
        assertThat(settings.user()).isEqualTo("ada");
        assertThat(settings.password()).isEqualTo("of the environment");
        assertThatThrownBy(() -> parse("--bus-password secret")).isInstanceOf(ParameterException.class);
        assertThat(settings("--bus nats://base").password()).isNull();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            value = {
                "--name x | --bus is missing, expected an address like nats://HOST:4222",
                "--bus base:4222 | --bus is base:4222: expected an address like nats://HOST:4222",
                "--bus http://base | --bus is http://base: expected an address like nats://HOST:4222",
                "--bus nats://ada:secret@base | --bus is nats://..@base: the address of the server has a password in it,"
                        + " which is easily shown to others: use --bus-user",
                "--bus nats://base --application a.b | --application is 'a.b', expected letters, digits, - and _",
                "--bus nats://base --bus-password-file DIR/x"
                        + " | --bus-password-file is DIR/x, but there is no user: expected --bus-user as well",
                "--bus nats://base --bus-user ada --bus-password-file DIR/x"
                        + " | DIR/x: no such file, expected a file whose first line is the password",
                "--bus nats://base --bus-user ada --bus-password-file DIR/empty"
                        + " | DIR/empty: the first line is empty, expected the password of ada",
                "--bus nats://base --bus-trust DIR/empty"
                        + " | DIR/empty: no certificate in it, expected a certificate in the PEM format"
                        + " (-----BEGIN CERTIFICATE-----)",
                "--bus nats://base --bus-trust DIR/text"
                        + " | DIR/text: no certificate in it, expected a certificate in the PEM format"
                        + " (-----BEGIN CERTIFICATE-----)",
            })
    void mistake_isOneLineThatNamesTheOption(String line, String problem) throws IOException {
        Files.writeString(folder.resolve("empty"), "");
        Files.writeString(folder.resolve("text"), "no certificate\n");
        assertThatThrownBy(() -> settings(line))
                .isInstanceOf(ParameterException.class)
                .hasMessage(problem.replace("DIR", folder.toString()));
    }

    @Test
    void userWithoutPassword_isRefused() {
        assertThatThrownBy(() -> parse("--bus nats://base --bus-user ada").settings(Map.of()))
                .isInstanceOf(ParameterException.class)
                .hasMessage("--bus-user is ada, but there is no password: expected --bus-password-file, or"
                        + " TROUPE_BUS_PASSWORD in the environment");
    }

    @Test
    void nameThatIsNone_isRefused() {
        assertThatThrownBy(() -> parse("--name a/b").node())
                .isInstanceOf(ParameterException.class)
                .hasMessage("--name is 'a/b', expected a name without a slash");
        assertThatThrownBy(() -> parse("--name a\u0007b").node())
                .hasMessage("--name has a control character in it, expected a name without one");
    }

    @Test
    void optionsWithoutABus_areRefused_whereTheBusIsOptional() {
        parse("--bus nats://base --name x").refuseWithoutBus();
        assertThatThrownBy(() -> parse("--name x").refuseWithoutBus())
                .isInstanceOf(ParameterException.class)
                .hasMessage("--name is x, but there is no bus: expected --bus as well");
    }
}
