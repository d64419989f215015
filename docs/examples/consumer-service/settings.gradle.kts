rootProject.name = "consumer-service"
