package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

/** Replays recorded conversations of real clients with a real server. */
class CapturesTest {
    @ParameterizedTest
    @ValueSource(
            strings = {
                "playerprint-ranger.txt",
                "s32-playerprint-position2d.txt",
                "s32-playerprint-sonar.txt",
                "s32-playerprint-blobfinder.txt"
            })
    void capturedMessage_decodedAndEncodedAgain_isTheSame(String name) throws WireException {
        List<Hex.Line> lines = Hex.capture(name);
        assertThat(lines).hasSizeGreaterThan(9);
        assertThat(Hex.text(lines.getFirst().bytes()))
                .as("banner")
                .isEqualTo(Hex.text(TcpServer.banner("Player v.3.1.1-dev")));
        for (var line : lines.subList(1, lines.size())) {
            WireMessage message = line.message();
            assertThat(Hex.text(message.bytes())).as("header of %s", message).isEqualTo(Hex.text(line.bytes()));
            Content again = again(message);
            assertThat(Hex.text(again.payload())).as("payload of %s", message).isEqualTo(Hex.text(message.payload()));
            assertThat(again.subtype()).isEqualTo(message.header().subtype());
        }
    }

    private static Content again(WireMessage message) throws WireException {
        Header header = message.header();
        int code = header.address().interfaceCode();
        int subtype = header.subtype();
        boolean player = code == PlayerRequest.INTERFACE;
        return switch (header.type()) {
            case DATA ->
                DataCodec.encode(
                        DataCodec.decode(code, subtype, message.payload()).orElseThrow());
            case CMD ->
                CommandCodec.encode(
                        CommandCodec.decode(code, subtype, message.payload()).orElseThrow());
            case REQ ->
                player
                        ? PlayerDeviceCodec.encode(PlayerDeviceCodec.request(subtype, message.payload()))
                        : RequestCodec.encode(code, RequestCodec.decode(code, subtype, message.payload()));
            case ACK, NACK ->
                new Content(
                        subtype,
                        player
                                ? PlayerDeviceCodec.encode(
                                        PlayerDeviceCodec.reply(header.type(), subtype, message.payload()))
                                : ReplyCodec.encode(
                                        ReplyCodec.decode(code, header.type(), subtype, message.payload())));
            case SYNCH -> PlayerDeviceCodec.synch(PlayerDeviceCodec.dropped(subtype, message.payload()));
        };
    }
}
