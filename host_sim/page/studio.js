"use strict"; const Studio = {start(){}};
