package io.troupe.view.live;

import io.troupe.common.process.Programs;
import io.troupe.view.Json;
import java.io.BufferedReader;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Base64;
import java.util.List;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;

/** Chromium without a window, driven over the WebDriver protocol. */
final class Browser implements AutoCloseable {
    private static final Pattern PORT = Pattern.compile("on port (\\d+)");
    private static final Pattern SESSION = Pattern.compile("\"sessionId\":\"([^\"]+)\"");
    private static final Pattern TEXT = Pattern.compile("\\{\"value\":\"((?:[^\"\\\\]++|\\\\.)*+)\"}");
    private static final Pattern ESCAPE = Pattern.compile("\\\\(u[0-9a-fA-F]{4}|.)");
    private static final Duration PATIENCE = Duration.ofMinutes(2);

    private final HttpClient client = HttpClient.newHttpClient();
    private final Process driver;
    private final String session;

    private Browser(Process driver, int port) {
        this.driver = driver;
        String options = "{\"args\":[\"--headless=new\",\"--no-sandbox\",\"--disable-gpu\",\"--disable-dev-shm-usage\","
                + "\"--hide-scrollbars\",\"--no-proxy-server\"]}";
        String wanted = "{\"capabilities\":{\"alwaysMatch\":{\"browserName\":\"chrome\",\"goog:chromeOptions\":"
                + options + ",\"goog:loggingPrefs\":{\"browser\":\"ALL\"},\"timeouts\":{\"script\":"
                + PATIENCE.toMillis() + "}}}}";
        String drivers = "http://localhost:" + port + "/session";
        Matcher id = SESSION.matcher(post(drivers, wanted));
        if (!id.find()) {
            throw new IllegalStateException("the browser did not start");
        }
        session = drivers + "/" + id.group(1);
    }

    /** Whether this machine has the browser and its driver. */
    static boolean isInstalled() {
        return Programs.onPath("chromedriver").isPresent()
                && Stream.of("chromium", "google-chrome", "chromium-browser")
                        .anyMatch(browser -> Programs.onPath(browser).isPresent());
    }

    static Browser open() throws IOException {
        Process driver = new ProcessBuilder("chromedriver", "--port=0")
                .redirectErrorStream(true)
                .start();
        BufferedReader output = driver.inputReader();
        for (String line = output.readLine(); line != null; line = output.readLine()) {
            Matcher port = PORT.matcher(line);
            if (line.contains("successfully") && port.find()) {
                Thread.ofVirtual().start(() -> output.lines().forEach(rest -> {})); // a full pipe would stop the driver
                return new Browser(driver, Integer.parseInt(port.group(1)));
            }
        }
        throw new IOException("chromedriver did not start");
    }

    private String post(String address, String json) {
        return exchange(HttpRequest.newBuilder(URI.create(address))
                .POST(HttpRequest.BodyPublishers.ofString(json))
                .header("Content-Type", "application/json")
                .build());
    }

    private String exchange(HttpRequest request) {
        try {
            HttpResponse<String> answer = client.send(request, HttpResponse.BodyHandlers.ofString());
            if (answer.statusCode() != 200) {
                throw new IllegalStateException(request.uri() + ": " + answer.body());
            }
            return answer.body();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new IllegalStateException(e);
        }
    }

    private String post(String command, Json content) {
        return post(session + "/" + command, content.toString());
    }

    void open(String address) {
        post("url", new Json().put("url", address));
    }

    /** Evaluates an expression in the page; its value as text. */
    String get(String expression) {
        return run("execute/sync", "return String(" + expression + ")");
    }

    double number(String expression) {
        return Double.parseDouble(get(expression));
    }

    /** Returns when a condition of the page holds, which it is asked for at every frame that it draws. */
    void await(String condition) {
        run(
                "execute/async",
                "const done = arguments[0]; const look = () => { let holds = false; try { holds = " + condition
                        + "; } catch (error) {} if (holds) done('true'); else setTimeout(look, 15); }; look();");
    }

    private String run(String command, String script) {
        String answer = post(command, new Json().put("script", script).put("args", new Json.Fragment("[]")));
        Matcher text = TEXT.matcher(answer);
        if (!text.matches()) {
            throw new IllegalStateException(script + ": " + answer);
        }
        return ESCAPE.matcher(text.group(1)).replaceAll(found -> Matcher.quoteReplacement(unescape(found.group(1))));
    }

    private static String unescape(String escaped) {
        return switch (escaped.charAt(0)) {
            case 'u' -> String.valueOf((char) Integer.parseInt(escaped.substring(1), 16));
            case 'n' -> "\n";
            case 't' -> "\t";
            case 'r' -> "\r";
            default -> escaped;
        };
    }

    void size(int width, int height) {
        post("window/rect", new Json().put("width", width).put("height", height));
    }

    /** Presses the pointer at a point of the page, moves it there and there, and releases it at the last one. */
    void drag(List<int[]> points) {
        var actions = new StringBuilder();
        for (int[] point : points) {
            actions.append(actions.isEmpty() ? "" : ",")
                    .append("{\"type\":\"pointerMove\",\"duration\":60,\"x\":")
                    .append(point[0])
                    .append(",\"y\":")
                    .append(point[1])
                    .append("}")
                    .append(point == points.getFirst() ? ",{\"type\":\"pointerDown\",\"button\":0}" : "");
        }
        actions.append(",{\"type\":\"pointerUp\",\"button\":0}");
        post(
                session + "/actions",
                "{\"actions\":[{\"type\":\"pointer\",\"id\":\"mouse\",\"actions\":[" + actions + "]}]}");
    }

    /** Presses or releases a key, named by its WebDriver code. */
    void key(String type, char key) {
        String code = String.format("\\u%04x", (int) key);
        post(
                session + "/actions",
                "{\"actions\":[{\"type\":\"key\",\"id\":\"keys\",\"actions\":[{\"type\":\"" + type + "\",\"value\":\""
                        + code + "\"}]}]}");
    }

    void press(char key) {
        key("keyDown", key);
        key("keyUp", key);
    }

    byte[] screenshot() {
        String answer = exchange(
                HttpRequest.newBuilder(URI.create(session + "/screenshot")).build());
        Matcher text = TEXT.matcher(answer);
        if (!text.matches()) {
            throw new IllegalStateException("no screenshot");
        }
        return Base64.getDecoder().decode(text.group(1).getBytes(StandardCharsets.US_ASCII));
    }

    /** What the page has written to its console since the last call, with errors that the browser adds. */
    String console() {
        return post("se/log", new Json().put("type", "browser"));
    }

    @Override
    public void close() {
        try {
            exchange(HttpRequest.newBuilder(URI.create(session)).DELETE().build());
        } finally {
            driver.destroy();
        }
    }
}
