pluginManagement { repositories { mavenCentral() } }

rootProject.name = "consumer-kotlin"
