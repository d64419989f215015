package io.troupe.view.live;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;
import java.security.MessageDigest;
import java.security.NoSuchAlgorithmException;
import java.util.Base64;
import java.util.List;
import java.util.stream.Collectors;

/** The page, made of its parts: one text, which loads nothing. */
final class ViewPage {
    private static final List<String> SCRIPTS =
            List.of("messages.js", "model.js", "canvas.js", "timeline.js", "actors.js", "page.js");

    private final String html;
    private final String policy;

    private ViewPage(String html, String policy) {
        this.html = html;
        this.policy = policy;
    }

    /** The page that shows what its server sends. */
    static ViewPage live() {
        return of("");
    }

    /** The page that plays messages. */
    static ViewPage playing(String base64) {
        return of(base64);
    }

    private static ViewPage of(String data) {
        String style = read("page.css");
        String script = SCRIPTS.stream().map(ViewPage::read).collect(Collectors.joining("\n"));
        String policy = "default-src 'none'; connect-src 'self'; img-src data:; style-src " + hash(style)
                + "; script-src " + hash(script) + "; base-uri 'none'; form-action 'none'";
        String html = read("page.html")
                .replace("POLICY", policy)
                .replace("DATA", data)
                .replace("/*STYLE*/", style)
                .replace("/*SCRIPT*/", script);
        return new ViewPage(html, policy + "; frame-ancestors 'none'");
    }

    private static String read(String name) {
        try (var stream = ViewPage.class.getResourceAsStream(name)) {
            if (stream == null) {
                throw new IllegalStateException("the resource " + name + " of the live page is missing");
            }
            return new String(stream.readAllBytes(), StandardCharsets.UTF_8);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static String hash(String text) {
        try {
            byte[] digest = MessageDigest.getInstance("SHA-256").digest(text.getBytes(StandardCharsets.UTF_8));
            return "'sha256-" + Base64.getEncoder().encodeToString(digest) + "'";
        } catch (NoSuchAlgorithmException e) {
            throw new IllegalStateException("every Java platform has SHA-256", e);
        }
    }

    String html() {
        return html;
    }

    /** What the page may load and run. */
    String policy() {
        return policy;
    }
}
