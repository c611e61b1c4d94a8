"""The pictures of docs/pictures. See docs/draw-screens."""

import base64
import os
import pathlib
import tempfile

import browser
import program
import user

PICTURES = program.SOURCE / "docs/pictures"
MODEL, MOVE = "system2.toml", "trapezoid:stroke=12.56,velocity=50,cycles=4,torque_noise=1e-3"


def take(driver, name, section=None):
    """What is seen, from the top or from a section on."""
    browser.settle(driver)
    driver.execute_script(
        "document.documentElement.style.scrollBehavior = 'auto';"
        "const section = document.getElementById(arguments[0]);"
        "section ? section.scrollIntoView() : scrollTo(0, 0)",
        section,
    )
    browser.settle(driver)
    shot = base64.b64decode(driver.get_screenshot_as_base64())
    (PICTURES / (name + ".png")).write_bytes(shot)


def draw_report(driver):
    program.run("report", MODEL, "mystery.csv", "--out", "report.html")
    browser.look(driver, 1100, height=860)
    driver.get(pathlib.Path("report.html").resolve().as_uri())
    take(driver, "report")
    take(driver, "where", "where")
    take(driver, "candidates", "candidates")


def draw_studio(driver):
    with program.studio(MODEL, "mystery.csv") as url:
        u = user.User(driver, url)
        u.until_diagnosed()
        u.press(u.all("[data-add]")[0].get_attribute("id"))
        browser.wait(lambda: "+ " in u.text("do-undo"), "the effect", 30)
        u.quiet()
        browser.look(driver, 1100, dark=True, height=860)
        take(driver, "studio")


def main():
    PICTURES.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, browser.chromium() as driver:
        os.chdir(folder)
        pathlib.Path(MODEL).write_text((program.EXAMPLES / MODEL).read_text())
        drawn = ("--mystery", 26, "--experiment", MOVE, "--out", "mystery.csv")
        program.run("simulate", MODEL, *drawn)
        draw_report(driver)
        draw_studio(driver)


if __name__ == "__main__":
    main()
