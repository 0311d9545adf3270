"""What is predicted: finger, device, contact and read-out as frozen values, read from YAML and checked."""
